"""The rasterised method, in an OpenGL context of its own."""

from __future__ import annotations

from typing import Optional, Union

import numpy.typing as npt

from . import _arguments as arguments
from . import _lkao
from .ambient_occlusion import Answers, ray_options
from .pattern import Pattern, PlaneMaskTable
from .scene import positions_and_origin
from .view import View

_PRECISIONS = ("single", "double")


class Rasterizer:
    """Draws the occlusion of views with OpenGL 4.5: exact masks of the query, or the paper's approximate ones.

    device: "hardware", a GPU; "software", a rasteriser on the CPU; or "automatic", the first that there is. The context
    needs no window and belongs to the thread in which it is made. Raises RuntimeError with one line where there is no
    such device, or where lkao was built without OpenGL.
    """

    def __init__(self, device: str = "automatic") -> None:
        if not hasattr(_lkao, "Rasterizer"):
            raise RuntimeError("this lkao was built without OpenGL")
        self._rasterizer = _lkao.Rasterizer(arguments.word(device, "device"))

    @property
    def renderer(self) -> str:
        """What the driver calls itself."""
        return self._rasterizer.renderer

    @property
    def is_software(self) -> bool:
        """Whether the CPU draws."""
        return self._rasterizer.is_software

    def draw(
        self,
        V: npt.ArrayLike,
        F: npt.ArrayLike,
        view: View,
        samples: Union[int, Pattern, PlaneMaskTable] = 128,
        *,
        radius: float,
        sided: str = "two",
        seed: int = 0,
        rotation: float = 1.0,
        tilt: float = 0.0,
        surface_offset: Optional[float] = None,
        min_distance: float = 0.0,
        bent_normals: bool = False,
        precision: str = "single",
    ) -> Answers:
        """The pixels of a view, with what AmbientOcclusion.query(view.P, view.N, ...) casts for them.

        precision: in which the shaders decide: "single", where some 1e-6 of the rays differ from the query's, or
        "double", where none does. The others: see AmbientOcclusion.
        """
        if precision not in _PRECISIONS:
            raise ValueError(f"precision must be one of 'single', 'double', not {precision!r}")
        options = ray_options(radius, sided, rotation, tilt, seed, surface_offset, min_distance)
        table = samples if isinstance(samples, PlaneMaskTable) else PlaneMaskTable(samples)
        positions, _ = positions_and_origin(V, view._origin)
        triangles = arguments.triangles(F, len(positions))
        self._rasterizer.set_view(
            view._eye, view._target, view._up, view._fov, view.width, view.height, *view._rows
        )
        self._rasterizer.set_occluders(positions, triangles, view._origin, table._table, precision == "double")
        occlusion, bent, masks, _ = self._rasterizer.draw(options, bool(bent_normals))
        shape = (view.height, view.width)
        return Answers(
            occlusion.reshape(shape),
            None if bent is None else bent.reshape(*shape, 3),
            masks.reshape(*shape, -1),
            None,
        )
