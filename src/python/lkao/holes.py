"""Triangles with holes: leaves, fences, hair."""

from __future__ import annotations

from typing import Any, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _lkao

_LARGEST = 1 << 15  # a side
_OPAQUE = 65535


class Holes:
    """Where the triangles of a mesh are not there, by an image: for Scene, bake and others that take holes.

    alpha: (height, width), row by row from the top as pictures have them: uint8 or uint16, from 0, clear, to 255 or
        65535, opaque; or floats from 0 to 1. Kept with 16 bits.
    UV: (m, 3, 2), texture coordinates of the corners of triangles, as of MeshFile; those of vertices are UV[F].
        Triangles with a NaN are whole.
    cutoff: rays pass where alpha is below it, as of glTF's alphaMode MASK; None: half-transparent, each ray is blocked
        with the probability alpha, drawn by the triangle's number and the place where it is met (BLEND).
    uv_origin: where in the picture (0, 0) is, "lower" or "upper" left. wrap: what lies outside of [0, 1]: "repeat",
        "mirror" or "clamp"; or a pair, for u and v.
    smooth: whether alpha is linear between the middles of texels; otherwise a texel has one.

    Defaults are those of glTF, and so are the bits: a file that says the same has the same answers. No function of
    Python is called for rays. Can be pickled. Raises ValueError and TypeError naming the argument.
    """

    def __init__(
        self,
        alpha: npt.ArrayLike,
        UV: npt.ArrayLike,
        *,
        cutoff: Optional[float] = 0.5,
        uv_origin: str = "lower",
        wrap: Union[str, Tuple[str, str]] = "repeat",
        smooth: bool = True,
    ) -> None:
        uvs = arguments.numeric(UV, "UV").astype(np.float64)
        if uvs.ndim != 3 or uvs.shape[1:] != (3, 2):
            raise ValueError(f"UV must have the shape (m, 3, 2), not {uvs.shape}")
        if arguments.is_lower(uv_origin):
            uvs[..., 1] = 1 - uvs[..., 1]
        has_holes = np.isfinite(uvs).all((1, 2))
        count = int(has_holes.sum())
        numbers = np.full(len(uvs), arguments.NONE_OF_THEM, np.uint32)
        numbers[has_holes] = np.arange(count)
        level = None if cutoff is None else arguments.number(cutoff, "cutoff")
        if level is not None and np.isnan(level):
            raise ValueError("cutoff must be a number, not nan")
        self._holes = _lkao.Holes.make(
            [_texels(alpha)],
            [(level, 1.0, 0, *arguments.wraps(wrap), bool(smooth))],
            np.zeros(count, np.uint32),
            np.ascontiguousarray(uvs[has_holes], np.float32),
            np.ones((count, 3), np.float32),
            numbers,
        )

    @property
    def triangle_count(self) -> int:
        """m, of the mesh that they are of."""
        return len(self._holes.numbers())

    @property
    def triangles(self) -> npt.NDArray[np.bool_]:
        """(m,), whether the triangle may have holes. The others are whole, and cost what they do otherwise."""
        result: npt.NDArray[np.bool_] = self._holes.numbers() != arguments.NONE_OF_THEM
        return result

    def __reduce__(self) -> Tuple[Any, ...]:
        return _of_parts, self._holes.parts()

    def __repr__(self) -> str:
        return f"<lkao.Holes in {int(self.triangles.sum())} of {self.triangle_count} triangles>"


def of_extension(holes: Optional[_lkao.Holes]) -> Optional[Holes]:
    """What the extension module found."""
    if holes is None:
        return None
    result = Holes.__new__(Holes)
    result._holes = holes
    return result


def to_extension(holes: Optional[Holes], triangle_count: int, name: str = "holes") -> Optional[_lkao.Holes]:
    """What the extension module takes for a mesh of so many triangles."""
    if holes is None:
        return None
    if not isinstance(holes, Holes):
        raise TypeError(f"{name} must be Holes or None, not {type(holes).__name__}")
    if holes.triangle_count != triangle_count:
        raise ValueError(f"{name} must be of {triangle_count} triangles, as F has, not of {holes.triangle_count}")
    return holes._holes


def _of_parts(*parts: Any) -> Optional[Holes]:
    return of_extension(_lkao.Holes.make(*parts))


def _texels(alpha: npt.ArrayLike) -> npt.NDArray[np.uint16]:
    array = arguments.numeric(alpha, "alpha")
    if array.ndim != 2 or not all(1 <= side <= _LARGEST for side in array.shape):
        raise ValueError(f"alpha must have the shape (height, width), each from 1 to {_LARGEST}, not {array.shape}")
    if array.dtype == np.uint8:
        return np.ascontiguousarray(array.astype(np.uint16) * np.uint16(_OPAQUE // 255))
    if array.dtype == np.uint16:
        return np.ascontiguousarray(array)
    if array.dtype.kind != "f":
        raise TypeError(f"alpha must be of uint8, uint16 or floats, not {array.dtype}")
    bad = ~((array >= 0) & (array <= 1))
    if bad.any():
        raise ValueError(f"alpha must be from 0 to 1, not {array[bad].flat[0]}")
    rounded: npt.NDArray[np.uint16] = np.floor(array.astype(np.float64) * _OPAQUE + 0.5).astype(np.uint16)
    return np.ascontiguousarray(rounded)
