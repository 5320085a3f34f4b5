"""Sample patterns, and the tables of their plane masks."""

from __future__ import annotations

from typing import Callable, Optional, Tuple, Union

import numpy.typing as npt

from . import _arguments as arguments
from . import _lkao
from ._arguments import Floats, Words

Falloff = Union[str, Tuple[str, float], Callable[[float], float]]


def _falloff(falloff: Falloff) -> Tuple[str, Optional[float], Optional[Callable[[float], float]]]:
    if callable(falloff):
        return getattr(falloff, "__name__", "custom"), None, falloff
    if isinstance(falloff, tuple) and len(falloff) == 2 and falloff[0] == "exponential":
        return falloff[0], arguments.number(falloff[1], "falloff rate"), None
    if not isinstance(falloff, str):
        raise TypeError(f"falloff must be a name, ('exponential', rate) or a function, not {falloff!r}")
    return falloff, None, None


class Pattern:
    """Shadow rays around +z, with the AO radius as unit of length. Immutable; for any number of threads.

    samples: how many, 1 to 1024.
    kind: how directions are spread: "lloyd" (the best), "fibonacci", "sobol", "paper" or "random".
    falloff: how much an occluder at distance x (a share of the radius, 0 to 1) darkens, 1 to 0, never rising:
        "constant", "linear", "smooth", "exponential", ("exponential", rate), or a function of x, which is called some
        ten thousand times.
    weighting: "cosine", ambient occlusion as renderers define it; or "uniform", shares of solid angle.

    Raises ValueError naming the argument where one is out of range.
    """

    def __init__(
        self,
        samples: int = 128,
        *,
        kind: str = "lloyd",
        falloff: Falloff = "constant",
        seed: int = 0,
        weighting: str = "cosine",
    ) -> None:
        self._pattern = _lkao.SamplePattern.make(
            arguments.word(kind, "kind"),
            arguments.whole(samples, "samples", 1, 1024),
            *_falloff(falloff),
            arguments.seed(seed),
            arguments.word(weighting, "weighting"),
        )

    @classmethod
    def _of(cls, pattern: _lkao.SamplePattern) -> Pattern:
        result = cls.__new__(cls)
        result._pattern = pattern
        return result

    @classmethod
    def from_disk(cls, points: npt.ArrayLike, lengths: npt.ArrayLike) -> Pattern:
        """A pattern of one's own: points (n, 2) inside the unit disk, each the direction (x, y, sqrt(1 - x^2 - y^2)),
        and lengths (n,) from 0 to 1. Raises ValueError naming the first bad ray."""
        disk = arguments.packed(points, "points", (None, 2))
        return cls._of(_lkao.SamplePattern.from_disk(disk, arguments.packed(lengths, "lengths", (len(disk),))))

    def with_falloff(self, falloff: Falloff) -> Pattern:
        """The same directions with the lengths of another falloff."""
        return Pattern._of(self._pattern.with_falloff(*_falloff(falloff)))

    @property
    def ray_count(self) -> int:
        """How many rays there are."""
        return self._pattern.ray_count

    @property
    def word_count(self) -> int:
        """64-bit words of a mask."""
        return self._pattern.word_count

    @property
    def lowest_elevation(self) -> float:
        """Of the lowest ray above the horizon, in radians."""
        return self._pattern.lowest_elevation

    @property
    def disk(self) -> Floats:
        """(n, 2): points on the unit disk. A copy, as the following are."""
        return self._pattern.disk

    @property
    def directions(self) -> Floats:
        """(n, 3): unit vectors with z > 0."""
        return self._pattern.directions

    @property
    def lengths(self) -> Floats:
        """(n,): from 0 to 1, the AO radius."""
        return self._pattern.lengths

    def __repr__(self) -> str:
        return f"<lkao.Pattern of {self.ray_count} rays>"


def pattern_of(samples: Union[int, Pattern], name: str = "samples") -> Pattern:
    """The pattern itself, or the default one of so many rays."""
    if isinstance(samples, Pattern):
        return samples
    return Pattern(arguments.whole(samples, name, 1, 1024))


class PlaneMaskTable:
    """Which rays of a pattern end beyond a plane, by one look-up: for AmbientOcclusion, and for Rasterizer.

    samples: a Pattern, or the number of rays of the default one.
    resolution: 32 to 256; the table has about resolution^3 cells.
    masks: "must_may", exact, or "nearest", the paper's approximate ones in half the memory.
    addressing: "slices", or "cube", the paper's.
    threads: that build it, 0: all.

    Takes about resolution^3 x rays / 8 bytes, twice that with "must_may", and as much again where ray lengths differ.
    """

    def __init__(
        self,
        samples: Union[int, Pattern] = 128,
        *,
        resolution: int = 128,
        masks: str = "must_may",
        addressing: str = "slices",
        threads: int = 0,
    ) -> None:
        self.pattern = pattern_of(samples)
        self._table = _lkao.PlaneMaskTable.make(
            self.pattern._pattern,
            arguments.whole(resolution, "resolution", 32, 256),
            arguments.word(addressing, "addressing"),
            arguments.word(masks, "masks"),
            arguments.threads(threads),
        )

    def cell(self, normal: npt.ArrayLike, distance: float) -> int:
        """Of the plane with that unit normal, which points away from the receiver, at that distance in [0, 1]."""
        return self._table.cell(arguments.triple(normal, "normal"), arguments.number(distance, "distance"))

    def masks_of(self, cell: int) -> Words:
        """(2, words): rays beyond all planes of the cell, and rays beyond some; or (1, words), those of the nearest."""
        return self._table.masks_of(arguments.whole(cell, "cell", 0, self.cell_count - 1))

    @property
    def cell_count(self) -> int:
        return self._table.cell_count

    @property
    def memory_bytes(self) -> int:
        return self._table.memory_bytes

    @property
    def build_seconds(self) -> float:
        return self._table.build_seconds
