"""What receivers see of a light, and of the sky."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _lkao
from ._arguments import Floats, Triple, Words
from ._lkao import QueryReport
from .pattern import Pattern, pattern_of
from .receivers import offset_of, outputs, receivers_of
from .scene import Progress, Scene


@dataclass(frozen=True)
class DiscLight:
    """A flat disc, seen from both sides: its centre (3,), its normal (3,) of any length, and its radius."""

    position: Sequence[float]
    normal: Sequence[float]
    radius: float


@dataclass(frozen=True)
class SphereLight:
    """A sphere: its centre (3,) and its radius."""

    position: Sequence[float]
    radius: float


@dataclass(frozen=True)
class LightAnswers:
    """Of receivers P (..., 3).

    visibility: (...), share of the light that is seen, 0 to 1; NaN where a receiver is invalid.
    above_horizon: (...), share of the light above the horizon of the geometric normal.
    masks: (..., words), whether the ray to point i of the light is blocked (unpack); None where not asked for.
    """

    visibility: Floats
    above_horizon: Floats
    masks: Optional[Words]
    report: QueryReport


class SoftShadows:
    """Visibility of one light in one scene. Immutable; for any number of threads.

    samples: rays to the light; or a Pattern, whose disk says where on the light they end.
    rotation: the light's points are turned by up to so many turns, 0 to 1, from receiver to receiver.
    The others: see AmbientOcclusion.
    """

    def __init__(
        self,
        scene: Scene,
        light: Union[DiscLight, SphereLight],
        samples: Union[int, Pattern] = 128,
        *,
        sided: str = "two",
        rotation: float = 1.0,
        seed: int = 0,
        surface_offset: Optional[float] = None,
        kernel: str = "simd",
    ) -> None:
        if not isinstance(light, (DiscLight, SphereLight)):
            raise TypeError(f"light must be a DiscLight or a SphereLight, not {type(light).__name__}")
        self._origin = scene.origin
        self._kept = scene._kept
        self.pattern = pattern_of(samples)
        x, y, z = np.subtract(arguments.triple(light.position, "position"), scene.origin)
        position: Triple = (float(x), float(y), float(z))
        self._shadows = _lkao.SoftShadows.make(
            scene._scene,
            position,
            arguments.triple(light.normal, "normal") if isinstance(light, DiscLight) else None,
            arguments.number(light.radius, "radius"),
            self.pattern._pattern,
            arguments.word(sided, "sided"),
            arguments.number(rotation, "rotation"),
            arguments.seed(seed),
            offset_of(surface_offset),
            arguments.word(kernel, "kernel"),
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
        masks: bool = False,
        threads: int = 0,
        progress: Optional[Progress] = None,
    ) -> LightAnswers:
        """Many receivers: the arguments are those of AmbientOcclusion.query."""
        receivers, shape = receivers_of(
            P, N, self._origin, geometric_normals, excluded, excluded_instances, groups
        )
        visibility, visibility_rows = outputs(shape, 0, np.float32)
        above, above_rows = outputs(shape, 0, np.float32)
        words, word_rows = outputs(shape, self.pattern.word_count, np.uint64) if masks else (None, None)
        report = self._shadows.query(
            receivers,
            visibility_rows,
            above_rows,
            word_rows,
            arguments.seed(first_index, "first_index"),
            arguments.threads(threads),
            arguments.callback(progress),
        )
        return LightAnswers(visibility, above, words, report)


@dataclass(frozen=True)
class SkyAnswers:
    """Of receivers P (..., 3), shares of solid angle, 0 to 1; NaN where a receiver is invalid.

    visibility: (...), of the whole sphere. above, below: (...), of the hemispheres on the side of the geometric normal
        and on the other one.
    """

    visibility: Floats
    above: Floats
    below: Floats
    report: QueryReport


class SkyVisibility:
    """What share of all directions sees the sky: for leaves and other thin things. Immutable; for any threads.

    samples: rays of the whole sphere, 2 to 2048, rounded up to an even number. radius: where the sky begins.
    """

    def __init__(
        self,
        scene: Scene,
        samples: int = 256,
        *,
        radius: float = float("inf"),
        sided: str = "two",
        seed: int = 0,
        surface_offset: Optional[float] = None,
        kernel: str = "simd",
    ) -> None:
        self._origin = scene.origin
        self._kept = scene._kept
        self._sky = _lkao.SkyVisibility.make(
            scene._scene,
            arguments.whole(samples, "samples", 2, 2048),
            arguments.number(radius, "radius"),
            arguments.word(sided, "sided"),
            arguments.seed(seed),
            offset_of(surface_offset),
            arguments.word(kernel, "kernel"),
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
        threads: int = 0,
        progress: Optional[Progress] = None,
    ) -> SkyAnswers:
        """Many receivers: the arguments are those of AmbientOcclusion.query."""
        receivers, shape = receivers_of(
            P, N, self._origin, geometric_normals, excluded, excluded_instances, groups
        )
        shares, share_rows = outputs(shape, 3, np.float32)
        report = self._sky.query(
            receivers,
            share_rows,
            arguments.seed(first_index, "first_index"),
            arguments.threads(threads),
            arguments.callback(progress),
        )
        return SkyAnswers(shares[..., 0], shares[..., 1], shares[..., 2], report)
