"""lkao: Laine-Karras bitmask ambient occlusion.

    import lkao
    V, F = lkao.load("builtin:atrium")
    occlusion = lkao.bake(V, F, radius=2.0)                      # of every vertex
    ao = lkao.AmbientOcclusion(lkao.Scene(V, F), 256, radius=2.0)
    answers = ao.query(P, N, bent_normals=True, masks=True)      # of any points, at once

Words: receiver, the point asked about; occluder, a triangle; AO radius, the longest ray; sample pattern, the rays
around the normal; occlusion mask, a bit for each ray that is blocked. Occlusion is 1 where everything is blocked,
visibility is 1 - occlusion. Arrays: V (n, 3), F (m, 3), P and N (..., 3) are positions and triangles of a mesh,
positions and normals of receivers, in any unit, in a right-handed space; angles are in radians, but a camera's.

Long calls run on all threads without the interpreter's lock, can be stopped by Ctrl-C or by their progress function,
and give the same bits on any number of threads. Wrong arguments raise TypeError or ValueError with one line that names
the argument.
"""

from ._lkao import BuildReport, Cancelled, QueryReport, version as __version__
from .ambient_occlusion import AmbientOcclusion, Answers, occlusion, unpack
from .baking import Baking, bake
from .bundles import RayBundles
from .gl import Rasterizer
from .holes import Holes
from .lights import DiscLight, LightAnswers, SkyAnswers, SkyVisibility, SoftShadows, SphereLight
from .meshes import Level, Mesh, MeshFile, load, simplify
from .pattern import Pattern, PlaneMaskTable
from .scene import Scene
from .texture_maps import TextureBake, TextureMap, TextureReport
from .textures import bake_texture
from .view import View

__all__ = [
    "AmbientOcclusion",
    "Answers",
    "Baking",
    "BuildReport",
    "Cancelled",
    "DiscLight",
    "Holes",
    "Level",
    "LightAnswers",
    "Mesh",
    "MeshFile",
    "Pattern",
    "PlaneMaskTable",
    "QueryReport",
    "Rasterizer",
    "RayBundles",
    "Scene",
    "SkyAnswers",
    "SkyVisibility",
    "SoftShadows",
    "SphereLight",
    "TextureBake",
    "TextureMap",
    "TextureReport",
    "View",
    "__version__",
    "bake",
    "bake_texture",
    "load",
    "occlusion",
    "simplify",
    "unpack",
]
