"""What is baked: a mesh with its normals, texture coordinates and materials."""

from __future__ import annotations

from typing import Optional, Union

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _lkao
from ._arguments import Array, Floats, Triple

NORMALS = ("facet", "smooth")
Normals = Union[str, npt.ArrayLike, None]


def surface_of(
    positions: Array,
    triangles: Array,
    origin: Triple,
    normals: Normals,
    *,
    name: str = "normals",
    uvs: Optional[Floats] = None,
    materials: Optional[npt.NDArray[np.uint32]] = None,
    holes: Optional[_lkao.Holes] = None,
) -> _lkao.Surface:
    """`name`: what users call the normals."""
    given = None
    if normals is None:
        source = "facet"
    elif isinstance(normals, str):
        if normals not in NORMALS:
            raise ValueError(f"{name} must be one of 'facet', 'smooth' or an array, not {normals!r}")
        source = normals
    else:
        source = "file"
        rows = arguments.of_vertices_or_corners(normals, name, 3, len(positions), len(triangles))
        given = np.ascontiguousarray(rows, np.float32)
    return _lkao.Surface(positions, triangles, origin, source, given, uvs, materials, holes)
