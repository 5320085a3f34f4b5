"""What a camera sees of a mesh: receivers, a pixel each."""

from __future__ import annotations

from typing import Optional

import numpy as np
import numpy.typing as npt

from . import _arguments as arguments
from . import _lkao
from .holes import Holes, to_extension
from .meshes import in_world
from .scene import positions_and_origin

_NORMALS = ("facet", "smooth")


class View:
    """Receivers of the pixels of a picture, row by row from the top, for AmbientOcclusion.query and Rasterizer.

    eye, target, up: (3,), in the coordinates of V. fov: horizontal, in degrees. width, height: pixels, 1 to 32768.
    normals: "facet", those of the triangles, or "smooth". holes: what is behind them is seen, where alpha is below the
        cut-off, or below a half.

    P, N, geometric_normals: (height, width, 3); depth: (height, width), along the view axis. Where nothing is seen P is
    NaN and depth infinite; occlusion is NaN there.
    """

    def __init__(
        self,
        V: npt.ArrayLike,
        F: npt.ArrayLike,
        *,
        eye: npt.ArrayLike,
        target: npt.ArrayLike,
        width: int,
        height: int,
        up: npt.ArrayLike = (0.0, 1.0, 0.0),
        fov: float = 60.0,
        normals: str = "facet",
        holes: Optional[Holes] = None,
        origin: Optional[npt.ArrayLike] = None,
    ) -> None:
        if normals not in _NORMALS:
            raise ValueError(f"normals must be one of 'facet', 'smooth', not {normals!r}")
        positions, its_origin = positions_and_origin(V, origin)
        ex, ey, ez = np.subtract(arguments.triple(eye, "eye"), its_origin)
        tx, ty, tz = np.subtract(arguments.triple(target, "target"), its_origin)
        self.width = arguments.whole(width, "width", 1, 32768)
        self.height = arguments.whole(height, "height", 1, 32768)
        self._origin = its_origin
        self._eye = (float(ex), float(ey), float(ez))
        self._target = (float(tx), float(ty), float(tz))
        self._up = arguments.triple(up, "up")
        self._fov = arguments.number(fov, "fov")
        triangles = arguments.triangles(F, len(positions))
        self._rows = _lkao.view(
            positions,
            triangles,
            its_origin,
            to_extension(holes, len(triangles)),
            self._eye,
            self._target,
            self._up,
            self._fov,
            self.width,
            self.height,
            normals == "smooth",
        )
        points, shading, geometric, depth = self._rows
        shape = (self.height, self.width)
        self.P = in_world(points, its_origin).reshape(*shape, 3)
        self.N = shading.reshape(*shape, 3)
        self.geometric_normals = geometric.reshape(*shape, 3)
        self.depth = depth.reshape(shape)
