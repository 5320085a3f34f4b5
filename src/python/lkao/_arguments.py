"""What users pass, as the extension module takes it; what cannot be, refused with a line that names it."""

from __future__ import annotations

import math
import operator
from typing import Any, Callable, Optional, SupportsFloat, SupportsIndex, Tuple, Union

import numpy as np
import numpy.typing as npt

FLOAT_MAX = float(np.finfo(np.float32).max)
NONE_OF_THEM = 0xFFFFFFFF

Array = npt.NDArray[Any]
Floats = npt.NDArray[np.float32]
Words = npt.NDArray[np.uint64]
Triple = Tuple[float, float, float]


def number(value: SupportsFloat, name: str) -> float:
    """A float that a float32 can hold, or an infinity."""
    if isinstance(value, (str, bytes)) or not hasattr(value, "__float__"):
        raise TypeError(f"{name} must be a number, not {type(value).__name__}")
    result = float(value)
    if math.isfinite(result) and abs(result) > FLOAT_MAX:
        raise ValueError(f"{name} must be at most {FLOAT_MAX:.3g}, not {result:.3g}; or float('inf')")
    return result


def whole(value: SupportsIndex, name: str, least: int, most: int) -> int:
    """An integer in [least, most]."""
    try:
        result = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} must be an integer, not {type(value).__name__}") from None
    if not least <= result <= most:
        raise ValueError(f"{name} must be from {least} to {most}, not {result}")
    return result


def seed(value: SupportsIndex, name: str = "seed") -> int:
    return whole(value, name, 0, 2**64 - 1)


def threads(value: SupportsIndex) -> int:
    return whole(value, "threads", 0, 4096)


def callback(value: Optional[Callable[[int, int], Any]]) -> Optional[Callable[[int, int], Any]]:
    if value is not None and not callable(value):
        raise TypeError(f"progress must be a function or None, not {type(value).__name__}")
    return value


def word(value: str, name: str) -> str:
    if not isinstance(value, str):
        raise TypeError(f"{name} must be a str, not {type(value).__name__}")
    return value


def triple(value: npt.ArrayLike, name: str) -> Triple:
    """Three finite numbers."""
    array = numeric(value, name)
    if array.shape != (3,):
        raise ValueError(f"{name} must have the shape (3,), not {array.shape}")
    x, y, z = (float(a) for a in array)
    if not all(map(math.isfinite, (x, y, z))):
        raise ValueError(f"{name} must be finite, not ({x}, {y}, {z})")
    return x, y, z


def numeric(value: npt.ArrayLike, name: str, kinds: str = "fiu", what: str = "floats or integers") -> Array:
    """An array of those kinds of dtype, in the machine's byte order."""
    try:
        array = np.asarray(value)
    except ValueError as error:  # rows of different lengths
        raise ValueError(f"{name} is no array: {str(error).splitlines()[0]}") from None
    if array.size == 0 and not isinstance(value, np.ndarray):
        array = array.astype(np.float32 if "f" in kinds else np.uint32)  # an empty list has no dtype of its own
    if array.dtype.kind not in kinds:
        raise TypeError(f"{name} must be an array of {what}, not of dtype {array.dtype}")
    return array if array.dtype.isnative else array.astype(array.dtype.newbyteorder("="))


def check_rows(array: Array, name: str) -> None:
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name} must have the shape (n, 3), not {array.shape}")


def as_float32_or_64(array: Array) -> Array:
    """As it is, if it is one of the two; otherwise a copy that loses no digit of 64-bit floats."""
    if array.dtype in (np.float32, np.float64):
        return array
    return array.astype(np.float32 if array.dtype == np.float16 else np.float64)


def with_rows_side_by_side(array: Array) -> Array:
    """As it is, where the numbers of a row lie side by side, and rows in ascending order; otherwise a copy."""
    if array.strides[1] == array.itemsize and array.strides[0] >= 3 * array.itemsize:
        return array
    return np.ascontiguousarray(array)


def positions(value: npt.ArrayLike, name: str = "V") -> Array:
    """Positions of vertices: (n, 3) of float32 or float64, copied only where dtype or layout ask for it."""
    array = as_float32_or_64(numeric(value, name))
    check_rows(array, name)
    return with_rows_side_by_side(array)


def triangles(value: npt.ArrayLike, position_count: int, name: str = "F") -> Array:
    """Indices of corners: (m, 3) of uint16, uint32 or int32, copied only where dtype or layout ask for it."""
    array = numeric(value, name, "iu", "integers")
    check_rows(array, name)
    if array.size > 0 and (array.min() < 0 or array.max() >= position_count):
        row, column = np.argwhere((array < 0) | (array >= position_count))[0]
        raise ValueError(
            f"{name}[{row}, {column}] is {array[row, column]}, but must be one of the {position_count} rows of V"
        )
    if array.dtype not in (np.uint16, np.uint32, np.int32):
        array = array.astype(np.uint32)
    return with_rows_side_by_side(array)


def rows(value: npt.ArrayLike, name: str) -> Array:
    """Points or vectors: (..., 3), as (n, 3) of float32 or float64, with any strides."""
    array = as_float32_or_64(numeric(value, name))
    if array.ndim < 1 or array.shape[-1] != 3:
        raise ValueError(f"{name} must have the shape (n, 3), not {array.shape}")
    return array


def packed(value: npt.ArrayLike, name: str, shape: Tuple[Optional[int], ...]) -> Floats:
    """Floats in an array of that shape, where None is any length."""
    array = numeric(value, name)
    if array.ndim != len(shape) or any(n is not None and n != m for n, m in zip(shape, array.shape)):
        wanted = ", ".join("n" if n is None else str(n) for n in shape)
        raise ValueError(f"{name} must have the shape ({wanted}{',' * (len(shape) == 1)}), not {array.shape}")
    return np.ascontiguousarray(array, dtype=np.float32)


def of_vertices_or_corners(value: npt.ArrayLike, name: str, width: int, n: int, m: int) -> Array:
    """One row of so many numbers for each of n vertices, (n, width), or of 3 m corners, (m, 3, width)."""
    array = numeric(value, name)
    if array.shape not in ((n, width), (m, 3, width)):
        raise ValueError(f"{name} must have the shape ({n}, {width}) or ({m}, 3, {width}), not {array.shape}")
    return array


def numbers(
    value: Union[npt.ArrayLike, None], name: str, shape: Tuple[int, ...], most: int = 2**32 - 1
) -> Optional[npt.NDArray[np.uint32]]:
    """Integers in [0, most], one for each of the shape, or one for all of it."""
    if value is None:
        return None
    array = numeric(value, name, "iu", "integers")
    if array.shape not in ((), shape):
        raise ValueError(f"{name} must have the shape {shape}, not {array.shape}")
    bad = (array < 0) | (array > most)
    if bad.any():
        raise ValueError(f"{name} must be from 0 to {most}, not {array[bad].flat[0]}")
    return np.broadcast_to(array.astype(np.uint32), shape).reshape(-1)


def numbers_or_none(
    value: Optional[npt.ArrayLike], name: str, shape: Tuple[int, ...]
) -> Optional[npt.NDArray[np.uint32]]:
    """As numbers(); -1 is none of them."""
    if value is None:
        return None
    array = numeric(value, name, "iu", "integers")
    return numbers(np.where(array == -1, NONE_OF_THEM, array.astype(np.int64)), name, shape)


def is_lower(uv_origin: str) -> bool:
    """Whether (0, 0) is the lower left corner of a picture; otherwise it is the upper one."""
    if uv_origin not in ("lower", "upper"):
        raise ValueError(f"uv_origin must be one of 'lower', 'upper', not {uv_origin!r}")
    return uv_origin == "lower"


def wraps(wrap: Union[str, Tuple[str, str]]) -> Tuple[str, str]:
    """Of u and of v."""
    words = (wrap, wrap) if isinstance(wrap, str) else tuple(wrap)
    if len(words) != 2:
        raise ValueError(f"wrap must be a word, or one for u and one for v, not {wrap!r}")
    return word(words[0], "wrap"), word(words[1], "wrap")


def required(array: Optional[npt.NDArray[np.uint32]]) -> npt.NDArray[np.uint32]:
    """For what is never None, packed."""
    assert array is not None
    return np.ascontiguousarray(array)
