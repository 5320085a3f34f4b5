"""Occlusion of the vertices, corners or faces of a mesh."""

from __future__ import annotations

from typing import Optional, Union

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _lkao
from ._arguments import Floats
from .ambient_occlusion import AmbientOcclusion
from .holes import Holes
from .meshes import in_world
from .pattern import Pattern
from .scene import Progress, Scene, check_holes, positions_and_origin
from .surface import Normals, surface_of

_FILTERS = ("none", "least-squares")


class Baking:
    """The receivers of a mesh, and what becomes of their occlusion.

    bake() in steps, for bakes in parts, on several machines: the receivers are the same wherever they are made, and
    parts of P, N and geometric_normals give the bits of the whole where AmbientOcclusion.query has their first_index.

    per: "vertex"; "corner", of triangles, where vertices differ along creases; or "face".
    filter: "none", the occlusion at the vertex; or "least-squares", what fits all of the faces best, for coarse meshes.
    normals: "facet" or None, each triangle's own; "smooth", averaged around each position; or an array: (n, 3), one a
        vertex, or (m, 3, 3), one a corner, of any length, such as those of a MeshFile. Where they are zero or NaN a
        corner is smooth. They also say what is in front of a triangle. No ray goes below the triangle's own horizon.
    scene: what blocks, in the coordinates of V; the mesh itself where it is not given.

    P, N, geometric_normals: (k, 3), the receivers.
    """

    def __init__(
        self,
        V: npt.ArrayLike,
        F: npt.ArrayLike,
        *,
        per: str = "vertex",
        filter: str = "none",
        normals: Normals = "facet",
        scene: Optional[Scene] = None,
    ) -> None:
        if filter not in _FILTERS:
            raise ValueError(f"filter must be one of 'none', 'least-squares', not {filter!r}")
        positions, origin = positions_and_origin(V, None if scene is None else scene.origin)
        surface = surface_of(positions, arguments.triangles(F, len(positions)), origin, normals)
        self._baking = _lkao.Baking(
            surface,
            arguments.word(per, "per"),
            filter == "least-squares",
            None if scene is None else scene._scene.bounds,
        )
        points, self.N, self.geometric_normals = self._baking.receivers()
        self.P = in_world(points, origin)

    def values(self, occlusion: npt.ArrayLike) -> Floats:
        """Of the receivers' occlusion (k,): that of the vertices (n,), the faces (m,) or the corners (m, 3). NaN where
        there is none, as of a vertex without a usable triangle. Any other quantity from 0 to 1 will do."""
        return self._baking.values(arguments.packed(occlusion, "occlusion", (self._baking.receiver_count,)))


def bake(
    V: npt.ArrayLike,
    F: npt.ArrayLike,
    *,
    radius: float,
    samples: Union[int, Pattern] = 128,
    per: str = "vertex",
    filter: str = "none",
    normals: Normals = "facet",
    holes: Optional[Holes] = None,
    scene: Optional[Scene] = None,
    sided: str = "two",
    seed: int = 0,
    min_distance: float = 0.0,
    threads: int = 0,
    progress: Optional[Progress] = None,
) -> npt.NDArray[np.float32]:
    """Occlusion of every vertex (n,), face (m,) or corner (m, 3) of a mesh, 0 to 1; NaN where there is none.

    V, F: see Scene. per, filter, normals, scene: see Baking. radius and the others: see AmbientOcclusion.
    holes: of the mesh, such as those of a MeshFile, where no scene is given. What lies in them is baked like all else.
    """
    check_holes(holes, scene)
    occluders = Scene(V, F, holes=holes, threads=threads) if scene is None else scene
    query = AmbientOcclusion(occluders, samples, radius=radius, sided=sided, seed=seed, min_distance=min_distance)
    baking = Baking(V, F, per=per, filter=filter, normals=normals, scene=occluders)
    answers = query.query(
        baking.P, baking.N, geometric_normals=baking.geometric_normals, threads=threads, progress=progress
    )
    return baking.values(answers.occlusion)
