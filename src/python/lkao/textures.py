"""Occlusion as textures of a mesh."""

from __future__ import annotations

from dataclasses import replace
from typing import Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _lkao
from ._arguments import Array, Floats, Triple
from .ambient_occlusion import AmbientOcclusion
from .holes import Holes, to_extension
from .pattern import Pattern
from .scene import Progress, Scene, check_holes, positions_and_origin
from .surface import Normals, surface_of
from .texture_maps import TextureBake, TextureMap, TextureReport, merged

_MOST_TEXELS = 32768  # a side


def _uvs(UV: npt.ArrayLike, F_UV: Optional[npt.ArrayLike], origin: str, n: int, m: int) -> Floats:
    """As the library has them: from the upper left corner."""
    is_lower = arguments.is_lower(origin)
    if F_UV is None:
        uvs = arguments.of_vertices_or_corners(UV, "UV", 2, n, m).astype(np.float64)
    else:
        uvs = _of_corners(UV, F_UV, m)
    if is_lower:
        uvs[..., 1] = 1 - uvs[..., 1]
    return np.ascontiguousarray(uvs, np.float32)


def _of_corners(UV: npt.ArrayLike, F_UV: npt.ArrayLike, m: int) -> Array:
    """Rows of UV by their numbers; NaN where that is -1."""
    rows = arguments.numeric(UV, "UV")
    if rows.ndim != 2 or rows.shape[1] != 2:
        raise ValueError(f"UV must have the shape (k, 2) where F_UV is given, not {rows.shape}")
    corners = arguments.numeric(F_UV, "F_UV", "iu", "integers")
    if corners.shape != (m, 3):
        raise ValueError(f"F_UV must have the shape of F, ({m}, 3), not {corners.shape}")
    bad = (corners < -1) | (corners >= len(rows))
    if bad.any():
        raise ValueError(f"F_UV must be from 0 to {len(rows) - 1}, the rows of UV, or -1, not {corners[bad].flat[0]}")
    with_none = np.vstack([rows.astype(np.float64), np.full((1, 2), np.nan)])
    result: Array = with_none[np.where(corners == -1, len(rows), corners.astype(np.int64))]
    return result


def _options(
    width: int,
    height: Optional[int],
    wrap: Union[str, Tuple[str, str]],
    udim: bool,
    material: Optional[int],
    grid: int,
    bent_normals: Optional[str],
    thickness: bool,
    level_seams: bool,
    margin: Optional[int],
) -> _lkao.TextureOptions:
    wrap_u, wrap_v = arguments.wraps(wrap)
    columns = arguments.whole(width, "width", 1, _MOST_TEXELS)
    number = None
    if material is not None:
        number = arguments.whole(material, "material", -1, arguments.NONE_OF_THEM) & arguments.NONE_OF_THEM
    return _lkao.TextureOptions(
        columns,
        columns if height is None else arguments.whole(height, "height", 1, _MOST_TEXELS),
        wrap_u,
        wrap_v,
        bool(udim),
        number,
        arguments.whole(grid, "grid", 1, 16),
        None if bent_normals is None else arguments.word(bent_normals, "bent_normals"),
        bool(thickness),
        bool(level_seams),
        None if margin is None else arguments.whole(margin, "margin", 0, _MOST_TEXELS),
    )


def _materials(
    materials: Optional[npt.ArrayLike], material: Optional[int], m: int
) -> Optional[npt.NDArray[np.uint32]]:
    if material is not None and materials is None:
        raise ValueError("material is one of materials, which must be given with it")
    numbers = arguments.numbers_or_none(materials, "materials", (m,))
    return None if numbers is None else np.ascontiguousarray(numbers)


def _detailed(
    mesh: Tuple[npt.ArrayLike, npt.ArrayLike], normals: Normals, holes: Optional[Holes], origin: Triple
) -> _lkao.Surface:
    if not isinstance(mesh, tuple) or len(mesh) != 2:
        raise TypeError("detailed must be a tuple of positions and triangles, (V, F)")
    positions, _ = positions_and_origin(mesh[0], origin, "V of detailed")
    triangles = arguments.triangles(mesh[1], len(positions), "F of detailed")
    its_holes = to_extension(holes, len(triangles), "detailed_holes")
    return surface_of(positions, triangles, origin, normals, name="detailed_normals", holes=its_holes)


def _blockers(
    V: npt.ArrayLike,
    F: npt.ArrayLike,
    holes: Optional[Holes],
    detailed: Optional[Tuple[npt.ArrayLike, npt.ArrayLike]],
    detailed_holes: Optional[Holes],
    origin: Triple,
    threads: int,
) -> Scene:
    """The detailed mesh, or else the mesh itself."""
    if detailed is None:
        return Scene(V, F, origin=origin, holes=holes, threads=threads)
    if holes is not None:
        raise ValueError("holes are of V and F, which do not block where there is a detailed mesh: see detailed_holes")
    return Scene(*detailed, origin=origin, holes=detailed_holes, threads=threads)


def _extrusion(value: Optional[float], has_detailed: bool) -> float:
    """0: the usual one."""
    if value is None:
        return 0.0
    if not has_detailed:
        raise ValueError("extrusion is for a detailed mesh, which must be given with it")
    distance = arguments.number(value, "extrusion")
    if not 0 < distance < float("inf"):
        raise ValueError(f"extrusion must be above 0 and finite, not {distance}")
    return distance


def _part(value: Optional[Tuple[int, int]]) -> Optional[Tuple[int, int]]:
    if value is None:
        return None
    if not isinstance(value, tuple) or len(value) != 2:
        raise TypeError("part must be a tuple of its number and how many there are, (k, n)")
    count = arguments.whole(value[1], "n of part", 1, 2**32 - 1)
    return arguments.whole(value[0], "k of part", 0, count - 1), count


def bake_texture(
    V: npt.ArrayLike,
    F: npt.ArrayLike,
    UV: npt.ArrayLike,
    F_UV: Optional[npt.ArrayLike] = None,
    *,
    radius: float,
    width: int = 1024,
    height: Optional[int] = None,
    samples: Union[int, Pattern] = 128,
    normals: Normals = "facet",
    uv_origin: str = "lower",
    wrap: Union[str, Tuple[str, str]] = "repeat",
    udim: bool = False,
    materials: Optional[npt.ArrayLike] = None,
    material: Optional[int] = None,
    grid: int = 1,
    margin: Optional[int] = None,
    level_seams: bool = True,
    bent_normals: Optional[str] = None,
    thickness: bool = False,
    detailed: Optional[Tuple[npt.ArrayLike, npt.ArrayLike]] = None,
    detailed_normals: Normals = "facet",
    detailed_holes: Optional[Holes] = None,
    extrusion: Optional[float] = None,
    holes: Optional[Holes] = None,
    scene: Optional[Scene] = None,
    sided: str = "two",
    seed: int = 0,
    min_distance: float = 0.0,
    part: Optional[Tuple[int, int]] = None,
    merge: Optional[Sequence[TextureBake]] = None,
    threads: int = 0,
    progress: Optional[Progress] = None,
) -> TextureBake:
    """Occlusion as a texture of a mesh, for the texture coordinates that it has; nothing is unwrapped.

    V, F: see Scene.
    UV: texture coordinates: (n, 2), one a vertex; (m, 3, 2), one a corner; or (k, 2) with F_UV, (m, 3): which of them
        the corners have. A corner of NaN, or of -1 in F_UV, has none, and its triangle blocks but is not baked.
    uv_origin: where in the picture (0, 0) is: "lower" left, as in OBJ files and most programs, or "upper" left, as in
        glTF files. Rows of the maps run from the top in either case.
    width, height: of the map in texels, 1 to 32768; height is the width where it is not given.
    samples, radius and others that are not here: see AmbientOcclusion. holes, scene: what blocks; see bake.
    normals: see Baking.
    wrap: what lies outside of [0, 1]: "repeat", "mirror" or "clamp"; or a pair, for u and v.
    udim: a map for each unit square of texture coordinates, instead of wrapping.
    materials, material: (m,), integers, and the one whose triangles are baked; all by default. The others block.
    grid: each texel has grid x grid receivers, 1 to 16.
    margin: texels by which charts grow beyond their borders; by default enough for mip maps of 64 texels.
    level_seams: whether both sides of the texture's cuts are made to show the same.
    bent_normals: "object", in the space of V; or "tangent", as in a tangent-space normal map (x along u, y along v
        upwards, those of glTF for a mesh without tangents).
    thickness: rays are cast into the body: what is open then is how thick it is, with a Pattern of linear falloff as
        a share of the radius.
    detailed: (V, F) of another mesh in the same space whose occlusion the map shows: each point stands for what lies
        nearest along the smooth normal within the distance `extrusion`, by default 2 % of the diagonal of the box
        around V. It alone blocks, if no scene is given. detailed_normals: see normals. detailed_holes: its
        Holes: rays pass, and so do points on their way to it.
    part: (k, n): only the k-th share of n, from 0 on, for several machines. merge: what that returned for all n, with
        the other arguments as they were there: nothing is cast, but the maps are put together and finished, with the
        bits of the whole.
    progress: counts texels; see Scene. While seams are levelled and gaps filled, it is told that all are there.

    Memory: 5 bytes a texel, 17 with bent normals, and some 1000 for each along a seam that is levelled. Raises
    ValueError and TypeError naming the argument, and ValueError where no triangle has texture coordinates.
    """
    options = _options(width, height, wrap, udim, material, grid, bent_normals, thickness, level_seams, margin)
    distance, share = _extrusion(extrusion, detailed is not None), _part(part)
    if share is not None and merge is not None:
        raise ValueError("part and merge exclude each other: one bakes a part, the other puts all of them together")
    positions, origin = positions_and_origin(V, None if scene is None else scene.origin)
    triangles = arguments.triangles(F, len(positions))
    n, m = len(positions), len(triangles)
    uvs = _uvs(UV, F_UV, uv_origin, n, m)
    surface = surface_of(
        positions, triangles, origin, normals, uvs=uvs, materials=_materials(materials, material, m)
    )
    if merge is not None:
        return _finished(merged(merge), surface, options)
    if detailed_holes is not None and detailed is None:
        raise ValueError("detailed_holes are for a detailed mesh, which must be given with them")
    fine = None if detailed is None else _detailed(detailed, detailed_normals, detailed_holes, origin)
    check_holes(holes, scene)
    if scene is None:
        scene = _blockers(positions, triangles, holes, detailed, detailed_holes, origin, threads)
    query = AmbientOcclusion(scene, samples, radius=radius, sided=sided, seed=seed, min_distance=min_distance)
    maps, report = _lkao.bake_texture(
        query._query,
        surface,
        scene._scene.bounds,
        options,
        fine,
        distance,
        share,
        arguments.threads(threads),
        arguments.callback(progress),
    )
    return TextureBake(tuple(TextureMap(*entries) for entries in maps), TextureReport(**report), share)


def _finished(bake: TextureBake, surface: _lkao.Surface, options: _lkao.TextureOptions) -> TextureBake:
    unfinished = [(m.udim, m.occlusion, m.bent_normals, m.coverage) for m in bake.maps]
    maps, seams = _lkao.finish_texture(surface, options, unfinished)
    return TextureBake(tuple(TextureMap(*entries) for entries in maps), replace(bake.report, **seams))
