"""Occluders: meshes, and instances of them."""

from __future__ import annotations

from typing import Any, Callable, Dict, Optional, Sequence, Tuple

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _lkao
from ._arguments import Array, Floats, Triple
from ._lkao import BuildReport
from .holes import Holes, to_extension

NO_ORIGIN: Triple = (0.0, 0.0, 0.0)
Progress = Callable[[int, int], Any]


def positions_and_origin(
    V: npt.ArrayLike, origin: Optional[npt.ArrayLike], name: str = "V"
) -> Tuple[Array, Triple]:
    """Positions as the library takes them, and what it takes away from 64-bit ones."""
    array = arguments.positions(V, name)
    if origin is None:
        return array, (_lkao.choose_origin(array) if array.dtype == np.float64 else NO_ORIGIN)
    its_origin = arguments.triple(origin, "origin")
    return (array if its_origin == NO_ORIGIN else array.astype(np.float64, copy=False)), its_origin


def transforms(to_world: npt.ArrayLike) -> Floats:
    """(n, 3, 4)."""
    array = arguments.numeric(to_world, "to_world")
    if array.ndim != 3 or array.shape[1:] not in ((3, 4), (4, 4)):
        raise ValueError(f"to_world must have the shape (n, 3, 4) or (n, 4, 4), not {array.shape}")
    if array.shape[1] == 4 and not (array[:, 3] == (0, 0, 0, 1)).all():
        raise ValueError("to_world must be affine: its last rows must be (0, 0, 0, 1)")
    return np.ascontiguousarray(array[:, :3], dtype=np.float32)


def check_holes(holes: Optional[Holes], scene: Optional[Scene]) -> None:
    """Of calls that take a scene instead of the mesh itself."""
    if holes is not None and scene is not None:
        raise ValueError("holes are of V and F, which do not block where there is a scene: give them to that Scene")


class Scene:
    """What blocks rays: a triangle mesh and the hierarchy over it.

    V: (n, 3), positions in any unit, of floats or integers. Those of float32 are taken as they are, in any layout that
        numpy has for ascending rows of three numbers side by side; others are copied. Of float64 and integers an origin
        near them is taken away before they become float32, if they are far from zero; what is asked about the scene
        stays in the coordinates of V.
    F: (m, 3), integers: three rows of V each. The front of a triangle is where its corners run counter-clockwise.
    copy: False keeps no copy of the mesh: V and F must not be changed as long as the scene is in use. The scene keeps
        them alive.
    spatial_splits: cut long triangles; takes 3 to 6 times as long to build, and up to a sixth less to query.
    keep_zero_area: keep triangles without area, for a mesh that is to stand elsewhere (Scene.of_instances).
    opacities: (m,), from 0 to 1: triangles below 1 have holes, and block a ray with that probability; or
    holes: Holes of the triangles of F, by images, such as those of a MeshFile.
    origin: taken away from positions instead of the one that is found.
    threads: 0: all. progress: called as progress(done, total) some twenty times a second; stops the build by returning
        False, and then Cancelled is raised. What it raises comes out of here.

    A scene made with copy=False, and one of instances of such, can be pickled: its arrays, holes and settings are, and
    the hierarchy is built anew on the other side, with the same bits.

    Built without the interpreter's lock. A scene may be asked from any number of threads. Raises ValueError and
    TypeError naming the argument. Triangles that block nothing are counted: see report.
    """

    def __init__(
        self,
        V: npt.ArrayLike,
        F: npt.ArrayLike,
        *,
        copy: bool = True,
        spatial_splits: bool = True,
        keep_zero_area: bool = False,
        opacities: Optional[npt.ArrayLike] = None,
        holes: Optional[Holes] = None,
        origin: Optional[npt.ArrayLike] = None,
        threads: int = 0,
        progress: Optional[Progress] = None,
    ) -> None:
        positions, its_origin = positions_and_origin(V, origin)
        triangles = arguments.triangles(F, len(positions))
        shares = None if opacities is None else arguments.packed(opacities, "opacities", (len(triangles),))
        own_holes = to_extension(holes, len(triangles))
        if shares is not None and own_holes is not None:
            raise ValueError("opacities and holes exclude each other: either says where triangles have holes")
        # The arrays that the hierarchy refers to; of a scene of instances, its meshes.
        self._kept: Tuple[Any, ...] = () if copy else (positions, triangles)
        # None of a scene of instances.
        self._settings: Optional[Dict[str, Any]] = {
            "spatial_splits": bool(spatial_splits),
            "keep_zero_area": bool(keep_zero_area),
            "opacities": None if copy or shares is None else shares.copy(),
            "holes": None if copy else holes,
        }
        self._scene = _lkao.OccluderScene.make(
            positions,
            triangles,
            its_origin,
            bool(spatial_splits),
            bool(keep_zero_area),
            not copy,
            shares,
            own_holes,
            arguments.threads(threads),
            arguments.callback(progress),
        )

    @classmethod
    def of_instances(
        cls,
        meshes: Sequence[Scene],
        to_world: npt.ArrayLike,
        *,
        mesh: Optional[npt.ArrayLike] = None,
        groups: Optional[npt.ArrayLike] = None,
        threads: int = 0,
    ) -> Scene:
        """Meshes in several places, each mesh in memory once.

        to_world: (n, 3, 4) or (n, 4, 4), affine and invertible, for columns: p becomes M p.
        mesh: (n,), of `meshes`; all are the first where it is not given.
        groups: (n,), 32 bits each: an instance blocks receivers that share one with it. All by default.

        Raises ValueError naming the instance where a transform cannot be, and where meshes have different origins.
        """
        for part in meshes:
            if not isinstance(part, Scene) or part._settings is None:
                raise TypeError("meshes must be Scenes of one mesh each")
        matrices = transforms(to_world)
        shape = (len(matrices),)
        result = cls.__new__(cls)
        result._kept = tuple(meshes)
        result._settings = None
        result._scene = _lkao.OccluderScene.make_instances(
            [part._scene for part in meshes],
            matrices,
            arguments.required(arguments.numbers(0 if mesh is None else mesh, "mesh", shape, len(meshes) - 1)),
            arguments.required(arguments.numbers(0xFFFFFFFF if groups is None else groups, "groups", shape)),
            arguments.threads(threads),
        )
        return result

    def refitted(
        self,
        V: npt.ArrayLike,
        *,
        max_growth: float = 2.0,
        threads: int = 0,
        progress: Optional[Progress] = None,
    ) -> Scene:
        """A scene of the same triangles where their corners have moved to, in a quarter of the time of a build. For a
        scene of one mesh; V has as many rows as it had. A hierarchy that would have grown by more than max_growth is
        built anew. This scene stays as it is."""
        if self._settings is None:
            raise ValueError("refitted is for a scene of one mesh: refit that, and give it to set_mesh")
        positions, _ = positions_and_origin(V, self.origin)
        result = Scene.__new__(Scene)
        result._kept = (positions, self._kept[1]) if self._kept else ()
        result._settings = self._settings
        result._scene = self._scene.refitted(
            positions,
            self.origin,
            arguments.number(max_growth, "max_growth"),
            arguments.threads(threads),
            arguments.callback(progress),
        )
        return result

    def move(self, instances: npt.ArrayLike, to_world: npt.ArrayLike) -> None:
        """Instances (n,) stand at to_world (n, 3, 4) from now on. What was made of the scene before stays as it was."""
        matrices = transforms(to_world)
        which = arguments.required(arguments.numbers(instances, "instances", (len(matrices),), self.instance_count - 1))
        self._scene.move(np.ascontiguousarray(which), matrices)

    def set_groups(self, instance: int, groups: int) -> None:
        """What an instance blocks from now on."""
        self._scene.set_groups(
            arguments.whole(instance, "instance", 0, self.instance_count - 1),
            arguments.whole(groups, "groups", 0, 0xFFFFFFFF),
        )

    def set_mesh(self, number: int, mesh: Scene) -> None:
        """Another mesh in the place of one of a scene of instances, as one that was refitted."""
        place = arguments.whole(number, "number", 0, self._scene.mesh_count - 1)
        if not isinstance(mesh, Scene) or mesh._settings is None:
            raise TypeError("mesh must be a Scene of one mesh")
        self._scene.set_mesh(place, mesh._scene)
        if self._settings is None:
            self._kept = (*self._kept[:place], mesh, *self._kept[place + 1 :])
        else:
            self._kept, self._settings = mesh._kept, mesh._settings

    def report(self, mesh: int = 0) -> BuildReport:
        """What the build of a mesh found and made: triangle_count, occluder_count, zero_area_count, ..."""
        return self._scene.report(arguments.whole(mesh, "mesh", 0, self._scene.mesh_count - 1))

    @property
    def instance_count(self) -> int:
        return self._scene.instance_count

    @property
    def occluder_count(self) -> int:
        """Triangles of all instances together that can block rays."""
        return self._scene.occluder_count

    @property
    def memory_bytes(self) -> int:
        return self._scene.memory_bytes

    @property
    def origin(self) -> Triple:
        """What was taken away from positions before they became float32: zero for those of float32."""
        return self._scene.origin

    @property
    def bounds(self) -> Tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """The least and the largest corner, (3,) each, of all occluders; (inf, -inf) where there is none."""
        lower, upper = self._scene.bounds
        return np.array(lower) + self.origin, np.array(upper) + self.origin

    def __reduce__(self) -> Tuple[Any, ...]:
        if self._settings is None:
            return _made_of_instances, (self._kept, *self._scene.instances())
        if not self._kept:
            raise TypeError("this Scene cannot be pickled, as it has not kept V and F: make it with copy=False")
        return _made_again, (*self._kept, self.origin, self._settings)

    def __repr__(self) -> str:
        return f"<lkao.Scene of {self.occluder_count} triangles>"


def _made_again(V: Array, F: Array, origin: Triple, settings: Dict[str, Any]) -> Scene:
    return Scene(V, F, copy=False, origin=origin, **settings)


def _made_of_instances(meshes: Sequence[Scene], to_world: Array, mesh: Array, groups: Array) -> Scene:
    return Scene.of_instances(meshes, to_world, mesh=mesh, groups=groups)
