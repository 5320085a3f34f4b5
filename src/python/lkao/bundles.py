"""Bundles of any rays that begin at one point."""

from __future__ import annotations

from typing import Optional

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _lkao
from ._arguments import Words
from .scene import Progress, Scene


class RayBundles:
    """Which of any rays of a common origin are blocked. Immutable; for any number of threads.

    sided: "two", or "one": triangles block only origins in front of them. kernel: as AmbientOcclusion.
    """

    def __init__(self, scene: Scene, *, sided: str = "two", kernel: str = "simd") -> None:
        self._origin = scene.origin
        self._kept = scene._kept
        self._bundles = _lkao.RayBundles.make(
            scene._scene, arguments.word(sided, "sided"), arguments.word(kernel, "kernel")
        )

    def blocked(
        self,
        origins: npt.ArrayLike,
        rays: npt.ArrayLike,
        *,
        excluded: int = -1,
        excluded_instance: int = 0,
        first_index: int = 0,
        threads: int = 0,
        progress: Optional[Progress] = None,
    ) -> Words:
        """Masks (..., words) of the segments from `origins` (..., 3) to origins + rays: rays are (..., k, 3), or (k, 3)
        for all origins, k from 1 to 1024. Rays of a bundle that point the same way should be neighbours.

        excluded: a triangle that cannot block; -1: none. first_index: what holes are drawn by (Scene, opacities).
        Raises ValueError where a coordinate is no number or too large.
        """
        points = arguments.rows(origins, "origins")
        shape = points.shape[:-1]
        segments = arguments.rows(rays, "rays")
        if segments.ndim < 2 or segments.shape[:-2] not in ((), shape):
            raise ValueError(f"rays must have the shape (k, 3) or {shape + ('k', 3)}, not {segments.shape}")
        ray_count = arguments.whole(segments.shape[-2], "the number of rays", 1, 1024)
        packed = np.ascontiguousarray(segments, dtype=np.float32)
        if segments.ndim > 2 or not shape:
            packed = packed.reshape(-1, ray_count, 3)
        masks = np.empty(shape + ((ray_count + 63) // 64,), np.uint64)
        self._bundles.blocked(
            points.reshape(-1, 3),
            packed,
            self._origin,
            arguments.NONE_OF_THEM if excluded == -1 else arguments.whole(excluded, "excluded", 0, 2**32 - 1),
            arguments.whole(excluded_instance, "excluded_instance", 0, 2**32 - 1),
            masks,
            arguments.seed(first_index, "first_index"),
            arguments.threads(threads),
            arguments.callback(progress),
        )
        return masks
