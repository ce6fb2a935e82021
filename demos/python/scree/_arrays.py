# Shaping of what users hand over into the arrays of the simulator.
"""Shaping of arrays."""
from __future__ import annotations

import difflib
import json
import operator
import typing
from typing import Any, List, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from scree._errors import SceneError

Array = npt.NDArray[Any]
Floats = npt.NDArray[np.float32]
Ids = npt.NDArray[np.int64]


def json_text(value: Any, where: str = "") -> str:
    """JSON of plain values, arrays and numpy numbers; refuses what JSON has no word for."""

    def plain(one: Any) -> Any:
        if isinstance(one, np.ndarray):
            return one.tolist()
        if isinstance(one, np.generic):
            return one.item()
        if isinstance(one, type):
            raise TypeError(f"{where or 'value'}: is the class {one.__name__}; make one: {one.__name__}(...)")
        if hasattr(one, "to_dict"):
            return one.to_dict()
        raise TypeError(f"{where or 'value'}: {type(one).__name__} has no place in a scene")

    try:
        return json.dumps(value, default=plain, allow_nan=False)
    except ValueError as error:
        raise SceneError(f"{where}: must be finite" if where else f"numbers must be finite ({error})", where) from None


def vectors(value: Any, count: int, width: int, name: str) -> Floats:
    """(count, width) float32 of an array of that shape or of one row; width 0: (count,) of that or of one number."""
    array: Floats = floats(value, name)
    shape = (count, width) if width else (count,)
    if array.shape in ((shape, (1, width), (width,)) if width else (shape, (1,), ())):
        return np.ascontiguousarray(np.broadcast_to(array, shape))
    wanted = f"({count}, {width}) or ({width},)" if width else f"({count},) or ()"
    raise ValueError(f"{name}: has the shape {array.shape}, should have {wanted}")


def floats(value: Any, name: str) -> Floats:
    """An array of float32; TypeError for what holds no numbers, such as "5"."""
    try:
        given = np.asarray(value)
        if given.dtype.kind in "US" or given.dtype.kind == "O" and any(isinstance(one, (str, bytes)) for one in given.flat):
            raise TypeError
        array: Floats = given.astype(np.float32, copy=False)
    except (TypeError, ValueError):
        kind = f"{value!r}" if isinstance(value, str) else type(value).__name__
        raise TypeError(f"{name}: is made of numbers, not {kind}") from None
    return array


def require_some(what: str, **given: Any) -> None:
    """Refuses a call that says nothing."""
    if all(value is None for value in given.values()):
        raise TypeError(f"{what}: give one at least of {', '.join(given)}")


def require_keys(given: typing.Iterable[str], known: typing.Iterable[str], what: str) -> None:
    """Refuses unknown keyword arguments as Python does, with the nearest known one."""
    names = list(known)
    for key in given:
        if key not in names:
            near = difflib.get_close_matches(key, names, 1)
            hint = f'; nearest: "{near[0]}"' if near else f"; known: {', '.join(names)}"
            raise TypeError(f'{what} has no "{key}"{hint}')


class Named(typing.Protocol):
    """What has named bodies and joints."""

    def names(self, things: str) -> List[str]: ...

    def indices_of(self, things: str, name: str) -> List[int]: ...


def index_by_name(native: Named, whose: str, things: str, name: str) -> int:
    """The index of the one of "bodies", "joints" or "vehicles" that has this name; KeyError for none, and for several.

    whose: "scene" or "world", for messages.
    """
    found = native.indices_of(things, name)
    if len(found) == 1:
        return found[0]
    if found:
        raise KeyError(f'"{name}" names {things} {found[0]} and {found[1]}: give an index, or each a name of its own')
    one = {"bodies": "body", "joints": "joint", "vehicles": "vehicle"}
    for other, how in (("joints", ".joint({})"), ("bodies", "[{}]")):
        elsewhere = native.indices_of(other, name) if other != things else []
        if elsewhere:
            quoted = f'"{name}"'
            raise KeyError(f'no {one[things]} is named "{name}", but {one[other]} {elsewhere[0]} is: {whose}{how.format(quoted)}')
    near = difflib.get_close_matches(name, [known for known in native.names(things) if known], 1)
    raise KeyError(f'no {one[things]} is named "{name}"' + (f'; nearest: "{near[0]}"' if near else ""))


def whole(value: Any, name: str) -> int:
    """A whole number, also of numpy's; TypeError for others."""
    try:
        if not isinstance(value, (bool, np.bool_)):
            return operator.index(value)
    except TypeError:
        pass
    raise TypeError(f"{name}: is a whole number, not {value!r}")


def index(value: Any, name: str) -> int:
    """A whole number from 0 on; IndexError for one below."""
    found = whole(value, name)
    if found < 0:
        raise IndexError(f"{name} {found}: numbers count from 0")
    return found


def count_of(value: Any, name: str, most: int = 2147483647) -> int:
    """A whole number from 0 to `most`; ValueError for others."""
    found = whole(value, name)
    if not 0 <= found <= most:
        raise ValueError(f"{name}: is {found}; must be 0 to {most}")
    return found


def number(value: Any, name: str) -> float:
    """A number; TypeError for what is none."""
    try:
        if not isinstance(value, str):
            return float(value)
    except (TypeError, ValueError):
        pass
    raise TypeError(f"{name}: is a number, not {value!r}")


def each(value: Optional[Any], shape: Tuple[int, ...], name: str) -> Optional[Floats]:
    """One number for each item of `shape`, one after the other, of numbers that broadcast to it."""
    if value is None:
        return None
    array = floats(value, name)
    try:
        return np.ascontiguousarray(np.broadcast_to(array, shape)).reshape(-1)
    except ValueError:
        raise ValueError(f"{name}: has the shape {array.shape}, should have {shape} or ()") from None


def triple(value: Any, name: str) -> Floats:
    """Three numbers."""
    array: Floats = floats(value, name)
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
        what = "names" if array.dtype.kind == "U" else str(array.dtype)
        raise TypeError(f"{of}: are told by whole numbers, or a mask of bools, not by {what}")
    if array.itemsize == 1 and array.size == count > 2 and set(array.reshape(-1).tolist()) <= {0, 1}:
        raise ValueError(f"{of}: {count} bytes of 0 and 1 look like a mask, which is of bools: .astype(bool)")
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


def turned(turns: Array, then: Array) -> Array:
    """Products of quaternions x, y, z, w, (n, 4)."""
    a, b = turns[:, :3], then[:, :3]
    made = np.empty_like(turns)
    made[:, :3] = turns[:, 3:] * b + then[:, 3:] * a + np.cross(a, b)
    made[:, 3] = turns[:, 3] * then[:, 3] - np.einsum("ij,ij->i", a, b)
    return made


def rotated(turns: Array, points: Array) -> Array:
    """Points, (n, 3), turned by quaternions of length 1."""
    axis = turns[:, :3]
    once = 2 * np.cross(axis, points)
    made: Array = points + turns[:, 3:] * once + np.cross(axis, once)
    return made


def maybe_vectors(value: Optional[Any], count: int, width: int, name: str) -> Optional[Floats]:
    return None if value is None else vectors(value, count, width, name)


Native = typing.TypeVar("Native", bound=Named)


class Bodies(typing.Generic[Native]):
    """The bodies of a Scene or World, as a container of their ids."""

    __slots__ = ()
    _native: Native

    def __len__(self) -> int:
        raise NotImplementedError

    def __iter__(self) -> typing.Iterator[int]:
        """The ids of the bodies."""
        return iter(range(len(self)))

    def __contains__(self, body: object) -> bool:
        """Whether there is a body of that name, or id."""
        if isinstance(body, str):
            return bool(self._native.indices_of("bodies", body))
        return isinstance(body, (int, np.integer)) and not isinstance(body, bool) and 0 <= int(body) < len(self)

    def __getitem__(self, name: Union[str, int]) -> int:
        """The id of the body of that name, in a World of copies in copy 0, or the id itself; raises KeyError, and IndexError.

        joint() finds joints.
        """
        if isinstance(name, str):
            return index_by_name(self._native, type(self).__name__.lower(), "bodies", name)
        body = whole(name, "body")
        if not 0 <= body < len(self):
            raise IndexError(f"body {body} of {len(self)}")
        return body
