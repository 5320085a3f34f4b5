"""What a bake into textures gives, and how its parts are put together."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import List, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from ._arguments import Floats


@dataclass(frozen=True)
class TextureMap:
    """Values of texels, (height, width), row by row from the top as pictures have them.

    udim: number of the UDIM tile; 0 where there are none.
    occlusion: 0 to 1; NaN only in a map of which nothing is known.
    bent_normals: (height, width, 3), unit vectors, mean directions of the rays that are not blocked; None where they
        were not asked for.
    coverage: uint8, what share of the texel triangles cover, in 255ths; where it is 0 the map is filled from around.
    """

    udim: int
    occlusion: Floats
    bent_normals: Optional[Floats]
    coverage: npt.NDArray[np.uint8]

    @property
    def visibility(self) -> Floats:
        """1 - occlusion."""
        return 1 - self.occlusion


@dataclass(frozen=True)
class TextureReport:
    """What was seen on the way. Triangles are those of the material.

    triangle_count: all of them.
    bare_triangle_count: without (finite) texture coordinates: not baked.
    flat_triangle_count: without area, or not finite, in space or in the texture: not baked.
    mirrored_triangle_count: baked; the texture shows them the wrong way round.
    outside_triangle_count: baked but for parts beyond a clamped edge, or beyond all UDIM tiles.
    wide_triangle_count: over more than 64 repeats: only the first 64 are baked.
    texel_count: of all maps. covered_texel_count: touched by triangles.
    overlapping_texel_count: wanted by several places of the surface at once; the first triangle has them.
    empty_texel_count: covered, but without a usable normal: filled from around.
    receiver_count: of all texels.
    missed_receiver_count: farther from the detailed mesh than the extrusion: these are on the mesh itself.
    seam_count: edges of the surface where the texture is cut; 0 where they are not levelled.
    worst_seam_before, worst_seam_after: how much both sides of a seam differed at most, and still do.
    """

    triangle_count: int
    bare_triangle_count: int
    flat_triangle_count: int
    mirrored_triangle_count: int
    outside_triangle_count: int
    wide_triangle_count: int
    texel_count: int
    covered_texel_count: int
    overlapping_texel_count: int
    empty_texel_count: int
    receiver_count: int
    missed_receiver_count: int
    seam_count: int
    worst_seam_before: float
    worst_seam_after: float


@dataclass(frozen=True)
class TextureBake:
    """The maps, one, or one for each UDIM tile that the mesh reaches, by number; and what was seen on the way.

    part: (k, n), where it is a part of a bake, whose maps are NaN elsewhere and still to be finished; None otherwise.
    occlusion, visibility, bent_normals, coverage: those of the only map; ValueError where there are more.
    """

    maps: Tuple[TextureMap, ...]
    report: TextureReport
    part: Optional[Tuple[int, int]] = None

    @property
    def map(self) -> TextureMap:
        """The only one."""
        if len(self.maps) != 1:
            raise ValueError(f"there are {len(self.maps)} maps, of UDIM tiles: see maps")
        return self.maps[0]

    @property
    def occlusion(self) -> Floats:
        return self.map.occlusion

    @property
    def visibility(self) -> Floats:
        return self.map.visibility

    @property
    def bent_normals(self) -> Optional[Floats]:
        return self.map.bent_normals

    @property
    def coverage(self) -> npt.NDArray[np.uint8]:
        return self.map.coverage


def merged(parts: Sequence[TextureBake]) -> TextureBake:
    """All parts of a bake as one, still to be finished."""
    count = len(parts)
    if not all(isinstance(part, TextureBake) and part.part is not None for part in parts):
        raise TypeError("merge must be what bake_texture has returned for parts")
    if count == 0 or sorted(part.part for part in parts if part.part) != [(k, count) for k in range(count)]:
        raise ValueError(f"merge must be all parts of a bake, each once, not {[part.part for part in parts]}")
    first = parts[0]
    if any(_kinds(part) != _kinds(first) for part in parts):
        raise ValueError("merge must be parts of one bake, which have the same maps")
    maps = tuple(_merged_map([part.maps[i] for part in parts]) for i in range(len(first.maps)))
    names = ["covered_texel_count", "overlapping_texel_count", "empty_texel_count"]
    names += ["receiver_count", "missed_receiver_count"]
    sums = {name: sum(getattr(part.report, name) for part in parts) for name in names}
    return TextureBake(maps, replace(first.report, **sums))


def _kinds(bake: TextureBake) -> List[Tuple[int, Tuple[int, ...], bool]]:
    return [(m.udim, m.coverage.shape, m.bent_normals is None) for m in bake.maps]


def _merged_map(maps: List[TextureMap]) -> TextureMap:
    """A texel is known in one of them at most."""
    occlusion, coverage = maps[0].occlusion.copy(), maps[0].coverage.copy()
    bent_normals = None if maps[0].bent_normals is None else maps[0].bent_normals.copy()
    for other in maps[1:]:
        known = other.coverage > 0
        np.copyto(occlusion, other.occlusion, where=known)
        np.copyto(coverage, other.coverage, where=known)
        if bent_normals is not None and other.bent_normals is not None:
            np.copyto(bent_normals, other.bent_normals, where=known[..., None])
    return TextureMap(maps[0].udim, occlusion, bent_normals, coverage)
