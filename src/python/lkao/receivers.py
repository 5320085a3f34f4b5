"""Points that are asked about, and the arguments that all questions share."""

from __future__ import annotations

from typing import Any, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _lkao
from ._arguments import Array, Triple

Shape = Tuple[int, ...]


def vectors(value: npt.ArrayLike, name: str, shape: Shape) -> Array:
    """One a point, or one for all, as (n, 3)."""
    array = arguments.rows(value, name)
    if array.shape not in ((3,), shape):
        raise ValueError(f"{name} must have the shape of P, {shape}, or (3,), not {array.shape}")
    return np.broadcast_to(array, shape).reshape(-1, 3)


def receivers_of(
    P: npt.ArrayLike,
    N: npt.ArrayLike,
    origin: Triple,
    geometric_normals: Optional[npt.ArrayLike] = None,
    excluded: Optional[npt.ArrayLike] = None,
    excluded_instances: Optional[npt.ArrayLike] = None,
    groups: Optional[npt.ArrayLike] = None,
) -> Tuple[_lkao.Receivers, Shape]:
    """Receivers, and the shape of what is said about them."""
    points = arguments.rows(P, "P")
    shape = points.shape[:-1]
    receivers = _lkao.Receivers(
        points.reshape(-1, 3),
        vectors(N, "N", points.shape),
        None if geometric_normals is None else vectors(geometric_normals, "geometric_normals", points.shape),
        arguments.numbers_or_none(excluded, "excluded", shape),
        arguments.numbers(excluded_instances, "excluded_instances", shape),
        arguments.numbers(groups, "groups", shape),
        origin,
    )
    return receivers, shape


def offset_of(surface_offset: Optional[float]) -> float:
    """The library's word for the automatic one is -1."""
    if surface_offset is None:
        return -1.0
    offset = arguments.number(surface_offset, "surface_offset")
    if offset < 0:
        raise ValueError(f"surface_offset must be at least 0, or None, not {offset}")
    return offset


def outputs(shape: Shape, width: int, dtype: Any) -> Tuple[Any, Any]:
    """A new array of `shape` + (width,), or of `shape` for width 0, and the same as rows."""
    array = np.empty(shape + (width,) * (width > 0), dtype)
    return array, array.reshape(-1, width) if width > 0 else array.reshape(-1)
