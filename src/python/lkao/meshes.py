"""Mesh files, built-in scenes, and levels of detail."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import List, NamedTuple, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _lkao
from ._arguments import Array, Floats, Triple
from .holes import Holes, of_extension
from .scene import NO_ORIGIN, Progress, Scene, positions_and_origin


def in_world(positions: Floats, origin: Triple) -> Array:
    """Positions with what was taken away from them: float64 only where that is not zero."""
    return positions if origin == NO_ORIGIN else positions.astype(np.float64) + origin


class Mesh(NamedTuple):
    """Positions (n, 3) and triangles (m, 3)."""

    V: Array
    F: npt.NDArray[np.uint32]


def load(name: Union[str, "os.PathLike[str]"]) -> Mesh:
    """The triangles of an OBJ, PLY, STL, OFF, glTF or GLB file, or of a built-in scene such as "builtin:atrium".

    V is float32, or float64 for files far from zero. Of holes by transparency MeshFile knows. Raises RuntimeError
    naming the file and the fault.
    """
    positions, triangles, origin = _lkao.load(os.fspath(name))
    return Mesh(in_world(positions, origin), triangles)


class MeshFile:
    """All that a file says of a surface, for Scene, bake and bake_texture.

    name: as of load. uv_set: which of its texture coordinates. opaque: holes by transparency are not read.

    V, F: as of load. origin: what the program takes away from positions: Scene(V, F, origin=origin) has its bits.
    holes: Holes by transparency, for what takes holes: of glTF alphaMode MASK and BLEND, of OBJ, half-transparent, "d",
        "Tr" and "map_d"; or None. What is baked without them is whole. An image that cannot be read counts as opaque,
        which is a remark.
    normals: (m, 3, 3), of the corners of triangles, unit vectors, NaN where there is none; or None.
    UV: (m, 3, 2), texture coordinates of corners, (0, 0) in the lower left corner of the picture; NaN where there is
        none; or None.
    materials: (m,), numbers in material_names, -1 where there is none; or None.
    wraps: of each material the words for bake_texture's wrap, as a pair; only of glTF.
    remarks: lines on what the file says, is not obeyed, and changes occlusion.

    Raises RuntimeError naming the file and the fault.
    """

    def __init__(self, name: Union[str, "os.PathLike[str]"], *, uv_set: int = 0, opaque: bool = False) -> None:
        found = _lkao.open_file(os.fspath(name), arguments.whole(uv_set, "uv_set", 0, 63), bool(opaque))
        points, self.F, self.origin, self.normals, uvs, materials, holes = found[:7]
        self.material_names, self.wraps, self.remarks = found[7:]
        self.holes: Optional[Holes] = of_extension(holes)
        self.V: Array = in_world(points, self.origin)
        self.UV: Optional[npt.NDArray[np.float64]] = None
        if uvs is not None:
            self.UV = np.stack([uvs[..., 0], 1 - uvs[..., 1].astype(np.float64)], -1)
        self.materials: Optional[npt.NDArray[np.int32]] = None if materials is None else materials.view(np.int32)


@dataclass(frozen=True)
class Level:
    """A mesh for the distances r_min to r_max along a ray, within epsilon of the original."""

    V: Array
    F: npt.NDArray[np.uint32]
    epsilon: float
    r_min: float
    r_max: float
    origin: Triple

    def scene(self) -> Scene:
        """To be given to AmbientOcclusion: [(level.scene(), level.r_min, level.r_max) for level in levels]."""
        return Scene(self.V, self.F, origin=self.origin)


def simplify(
    V: npt.ArrayLike,
    F: npt.ArrayLike,
    *,
    radius: Optional[float] = None,
    epsilon: Optional[float] = None,
    k: float = 3.0,
    growth: float = 3.0,
    levels: int = 4,
    threads: int = 0,
    progress: Optional[Progress] = None,
) -> List[Level]:
    """Levels of detail of a mesh: the original, and ever coarser ones for distances ever farther along a ray.

    radius: the AO radius, by which epsilon is chosen; or epsilon itself: the error of the first simplified level, in
        the unit of V. k: how many times its error a level stays away. growth: of epsilon from level to level.
    """
    if (radius is None) == (epsilon is None):
        raise TypeError("simplify takes either radius or epsilon")
    if epsilon is not None and not arguments.number(epsilon, "epsilon") > 0:
        raise ValueError(f"epsilon must be above 0, not {epsilon}")
    positions, origin = positions_and_origin(V, None)
    chain = _lkao.simplify(
        positions,
        arguments.triangles(F, len(positions)),
        origin,
        0.0 if radius is None else arguments.number(radius, "radius"),
        0.0 if epsilon is None else arguments.number(epsilon, "epsilon"),
        arguments.number(k, "k"),
        arguments.number(growth, "growth"),
        arguments.whole(levels, "levels", 1, 16),
        arguments.threads(threads),
        arguments.callback(progress),
    )
    return [
        Level(in_world(points, origin), corners, its_epsilon, r_min, r_max, origin)
        for points, corners, its_epsilon, r_min, r_max in chain
    ]
