"""The query: which shadow rays of a receiver are blocked."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _lkao
from ._arguments import Floats, Words
from ._lkao import QueryReport
from .holes import Holes
from .pattern import Pattern, PlaneMaskTable, pattern_of
from .receivers import offset_of, outputs, receivers_of
from .scene import Progress, Scene

Levels = Sequence[Tuple[Scene, float, float]]


@dataclass(frozen=True)
class Answers:
    """Of receivers P (..., 3).

    occlusion: (...), share of the cast rays that are blocked, 0 to 1; NaN where a receiver is invalid: a position that
        is not finite, a normal that is zero or not finite.
    bent_normals: (..., 3), mean direction of the rays that are not blocked; None where they were not asked for.
    masks: (..., words) of 64 bits: bit i % 64 of word i / 64 says that ray i is blocked (unpack); or None.
    report: how many rays were cast and blocked, how many receivers were invalid; None of a frame of OpenGL.
    """

    occlusion: Floats
    bent_normals: Optional[Floats]
    masks: Optional[Words]
    report: Optional[QueryReport]

    @property
    def visibility(self) -> Floats:
        """1 - occlusion."""
        return 1 - self.occlusion


def ray_options(
    radius: float,
    sided: str,
    rotation: float,
    tilt: float,
    seed: int,
    surface_offset: Optional[float],
    min_distance: float,
) -> _lkao.RayOptions:
    return _lkao.RayOptions(
        arguments.number(radius, "radius"),
        arguments.word(sided, "sided"),
        arguments.number(rotation, "rotation"),
        arguments.number(tilt, "tilt"),
        arguments.seed(seed),
        offset_of(surface_offset),
        arguments.number(min_distance, "min_distance"),
    )


class AmbientOcclusion:
    """Answers queries against one scene with one pattern.

    scene: a Scene; or levels of detail, near ones first: [(scene, r_min, r_max), ...], each blocking rays only between
        these distances from their origin (simplify makes them). Positions of V are those of the first.
    samples: the number of rays of the default pattern, 1 to 1024; a Pattern; or a PlaneMaskTable, to answer by the
        paper's look-ups.
    radius: AO radius, the length of the longest ray, in the unit of V; > 0, perhaps float("inf").
    sided: "two", or "one": triangles block only receivers in front of them.
    seed: with a receiver's index, the only source of its jitter.
    rotation: each receiver's pattern is turned by up to so many turns, 0 to 1. tilt: and tilted by up to so many
        radians, 0 to pi / 2.
    surface_offset: how far rays start off the surface, in units of 2^-24 x the largest coordinate in play; None: 16.
    min_distance: where rays begin to count, in the unit of V.
    kernel: "simd" or "scalar"; the bits are the same. node_masks: of a table, "box_outline" or "bounding_sphere".

    Immutable: it keeps the scene as it is now, and may be asked from any number of threads. Raises ValueError naming
    the argument where one is out of range.
    """

    def __init__(
        self,
        scene: Union[Scene, Levels],
        samples: Union[int, Pattern, PlaneMaskTable] = 128,
        *,
        radius: float,
        sided: str = "two",
        seed: int = 0,
        rotation: float = 1.0,
        tilt: float = 0.0,
        surface_offset: Optional[float] = None,
        min_distance: float = 0.0,
        kernel: str = "simd",
        node_masks: str = "box_outline",
    ) -> None:
        options = ray_options(radius, sided, rotation, tilt, seed, surface_offset, min_distance)
        levels = [(scene, 0.0, float("inf"))] if isinstance(scene, Scene) else list(scene)
        for level in levels:
            if not isinstance(level, tuple) or len(level) != 3 or not isinstance(level[0], Scene):
                raise TypeError("scene must be a Scene, or levels: [(Scene, r_min, r_max), ...]")
        if not levels:
            raise ValueError("scene must have a level at least")
        self._origin = levels[0][0].origin
        self._kept = [level[0]._kept for level in levels]
        if isinstance(samples, PlaneMaskTable):
            if not isinstance(scene, Scene):
                raise ValueError("samples must be no PlaneMaskTable where there are levels of detail")
            self.pattern = samples.pattern
            self._query = _lkao.AmbientOcclusion.make_with_table(
                scene._scene, samples._table, options, arguments.word(node_masks, "node_masks")
            )
            return
        self.pattern = pattern_of(samples)
        ranges = [
            (level._scene, arguments.number(r_min, "r_min"), arguments.number(r_max, "r_max"))
            for level, r_min, r_max in levels
        ]
        self._query = _lkao.AmbientOcclusion.make(
            ranges, self.pattern._pattern, options, arguments.word(kernel, "kernel")
        )

    def query(
        self,
        P: npt.ArrayLike,
        N: npt.ArrayLike,
        *,
        geometric_normals: Optional[npt.ArrayLike] = None,
        excluded: Optional[npt.ArrayLike] = None,
        excluded_instances: Optional[npt.ArrayLike] = None,
        groups: Optional[npt.ArrayLike] = None,
        first_index: int = 0,
        bent_normals: bool = False,
        masks: bool = False,
        threads: int = 0,
        progress: Optional[Progress] = None,
    ) -> Answers:
        """Many receivers at once, on all threads, without the interpreter's lock.

        P: (..., 3), positions in the coordinates of V, of floats or integers, at any strides, none of them copied.
        N: normals of that shape, of any length; or one, (3,), for all. The pattern's axis.
        geometric_normals: likewise, the side of the surface on which the receiver lies; those of N by default.
        excluded: (...), a triangle that cannot block, or -1. excluded_instances: of which instance. groups: (...), 32
            bits each: only instances that share one block.
        first_index: of the first receiver; the others follow. So parts of P, each with its own first_index, have the
            bits of the whole.
        bent_normals, masks: whether those are wanted too.
        threads: 0: all. progress: see Scene. Ctrl-C stops the query, in the main thread.
        """
        receivers, shape = receivers_of(
            P, N, self._origin, geometric_normals, excluded, excluded_instances, groups
        )
        occlusion, occlusion_rows = outputs(shape, 0, np.float32)
        bent, bent_rows = outputs(shape, 3, np.float32) if bent_normals else (None, None)
        words, word_rows = outputs(shape, self.pattern.word_count, np.uint64) if masks else (None, None)
        report = self._query.query(
            receivers,
            occlusion_rows,
            bent_rows,
            word_rows,
            arguments.seed(first_index, "first_index"),
            arguments.threads(threads),
            arguments.callback(progress),
        )
        return Answers(occlusion, bent, words, report)

    def rays(
        self, P: npt.ArrayLike, N: npt.ArrayLike, index: int = 0, geometric_normals: Optional[npt.ArrayLike] = None
    ) -> Tuple[npt.NDArray[np.float64], Floats, npt.NDArray[np.bool_]]:
        """The rays of one receiver of that index, P and N (3,): where they start, (3,); the segments, (n, 3); and which
        of them are cast, (n,). Bit for bit what query casts, for another ray tracer."""
        receivers, shape = receivers_of(P, N, self._origin, geometric_normals)
        if shape != ():
            raise ValueError(f"P must have the shape (3,), not {shape + (3,)}")
        start, segments, cast = self._query.rays(receivers, arguments.seed(index, "index"))
        return np.array(start) + self._origin, segments, unpack(cast, self.pattern.ray_count)


def unpack(masks: Words, ray_count: int) -> npt.NDArray[np.bool_]:
    """Masks (..., words) as (..., ray_count) of bool: whether ray i is blocked."""
    array = arguments.numeric(masks, "masks", "u", "uint64")
    if array.dtype != np.uint64 or array.ndim < 1 or array.shape[-1] != (ray_count + 63) // 64:
        raise ValueError(
            f"masks must be uint64 of the shape (..., {(ray_count + 63) // 64}) for {ray_count} rays, "
            f"not {array.dtype} of {array.shape}"
        )
    bytes_of = np.ascontiguousarray(array.astype("<u8", copy=False)).view(np.uint8)
    return np.unpackbits(bytes_of, axis=-1, bitorder="little")[..., :ray_count].astype(bool)


def occlusion(
    V: npt.ArrayLike,
    F: npt.ArrayLike,
    P: npt.ArrayLike,
    N: npt.ArrayLike,
    *,
    radius: float,
    samples: Union[int, Pattern] = 128,
    sided: str = "two",
    seed: int = 0,
    holes: Optional[Holes] = None,
    threads: int = 0,
    progress: Optional[Progress] = None,
) -> Floats:
    """Ambient occlusion of the points P with normals N by the mesh V, F: 0 where nothing is within the radius, 1 where
    all is blocked. For more than one question about a mesh, and for masks and bent normals: Scene, AmbientOcclusion.

    V, F, holes: see Scene. P, N: see AmbientOcclusion.query. radius, samples, sided, seed: see AmbientOcclusion.
    """
    query = AmbientOcclusion(Scene(V, F, holes=holes, threads=threads), samples, radius=radius, sided=sided, seed=seed)
    return query.query(P, N, threads=threads, progress=progress).occlusion
