# Shaping of what users hand over into the arrays of the simulator.
"""Shaping of arrays."""
from __future__ import annotations

import json
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from scree._errors import SceneError

Floats = npt.NDArray[np.float32]
Ids = npt.NDArray[np.int64]


def json_text(value: Any, where: str = "") -> str:
    """JSON of plain values, arrays and numpy numbers; refuses what JSON has no word for."""

    def plain(one: Any) -> Any:
        if isinstance(one, np.ndarray):
            return one.tolist()
        if isinstance(one, np.generic):
            return one.item()
        if hasattr(one, "to_dict"):
            return one.to_dict()
        raise TypeError(f"{where or 'value'}: {type(one).__name__} has no place in a scene")

    try:
        return json.dumps(value, default=plain, allow_nan=False)
    except ValueError as error:
        raise SceneError(f"{where}: must be finite" if where else f"numbers must be finite ({error})", where) from None


def vectors(value: Any, count: int, width: int, name: str) -> Floats:
    """(count, width) float32 of an array of that shape or of one row; width 0: (count,) of that or of one number."""
    array: Floats = np.asarray(value, dtype=np.float32)
    shape = (count, width) if width else (count,)
    try:
        return np.ascontiguousarray(np.broadcast_to(array, shape))
    except ValueError:
        wanted = f"({count}, {width}) or ({width},)" if width else f"({count},) or ()"
        raise ValueError(f"{name}: has the shape {array.shape}, should have {wanted}") from None


def triple(value: Any, name: str) -> Floats:
    """Three numbers."""
    array: Floats = np.asarray(value, dtype=np.float32)
    if array.shape != (3,):
        raise ValueError(f"{name}: has the shape {array.shape}, should have (3,)")
    return array


def ids_of(ids: Any, count: int, of: str = "bodies") -> Ids:
    """Ids as (n,) int64, of one id, a sequence, or a mask of all `count`."""
    array = np.asarray(ids)
    if array.dtype == np.bool_:
        if array.ndim != 1:
            raise ValueError(f"ids: a mask has the shape (n,), not {array.shape}")
        if array.size != count:
            raise IndexError(f"ids: a mask of {array.size} for {count} {of}")
        array = np.flatnonzero(array)
    if array.size == 0:
        return np.zeros(0, dtype=np.int64)
    if not np.issubdtype(array.dtype, np.integer):
        raise TypeError(f"ids: are whole numbers, not {array.dtype}")
    if array.ndim > 1:
        raise ValueError(f"ids: have the shape {array.shape}, should have (n,)")
    made: Ids = np.atleast_1d(array).astype(np.int64)
    return made


def unit(directions: Floats, name: str) -> Floats:
    """Directions of length 1. What is so already, to rounding, keeps its bits."""
    wide = directions.astype(np.float64)
    squared = np.einsum("ij,ij->i", wide, wide)
    if not np.all(np.isfinite(squared)) or np.any(squared == 0):
        wrong = int(np.flatnonzero(~np.isfinite(squared) | (squared == 0))[0])
        raise ValueError(f"{name}: number {wrong} is not finite, or of length 0")
    off = np.abs(squared - 1) > 2.5e-7
    if not off.any():
        return directions
    made = directions.copy()
    made[off] = (wide[off] / np.sqrt(squared[off])[:, None]).astype(np.float32)
    return made


def maybe_vectors(value: Optional[Any], count: int, width: int, name: str) -> Optional[Floats]:
    return None if value is None else vectors(value, count, width, name)
