# The simulator behind the package, by ctypes: use scree, not this.
"""Scenes and worlds as libscree has them; the package gives them their form."""
from __future__ import annotations

import contextlib
import ctypes
import functools
import json
import threading
import time
from typing import Any, Callable, Dict, Iterator, List, Mapping, Optional, Sequence, Tuple, TypeVar, Union

try:
    import numpy as np
    import numpy.typing as npt
except ImportError as error:
    raise ImportError(f"scree needs numpy 1.21 or later: pip install numpy ({error})") from None

from scree._library import (ALL_COPIES, LIBRARY, Array, Column, DebugOptions, EventOptions, GripOptions, LoadOptions, PictureOptions, RecordOptions, Statistics,
                            WorldInfo, WorldOptions, check, error_of, sized)

_Array = npt.NDArray[Any]
_Floats = npt.NDArray[np.float32]
_Ids = npt.NDArray[np.int64]
_Flags = npt.NDArray[np.bool_]
_MaybeFloats = Optional[_Floats]
_byref = ctypes.byref

version: str = LIBRARY.scree_version().decode()
has_vulkan = bool(LIBRARY.scree_has_vulkan())


# ---- Records, as the structs of scree.h lie in memory
def _record(size: int, **fields: Tuple[Any, int]) -> np.dtype[Any]:
    return np.dtype({"names": list(fields), "formats": [kind for kind, _ in fields.values()], "offsets": [at for _, at in fields.values()],
                     "itemsize": size})


contact_dtype = _record(136, a=("i8", 0), b=("i8", 8), part_a=("i4", 16), part_b=("i4", 20), normal=("(3,)f4", 24), friction=("(3,)f4", 36),
                        count=("i4", 48), position=("(4,3)f4", 52), separation=("(4,)f4", 100), force=("(4,)f4", 116))
event_dtype = _record(88, step=("i8", 0), kind=("u1", 52), a=("i8", 8), a_generation=("i8", 16), b=("i8", 24), b_generation=("i8", 32),
                      part_a=("i4", 40), part_b=("i4", 44), joint=("i4", 48), speed=("f4", 56), impulse=("f4", 60), point=("(3,)f4", 64),
                      normal=("(3,)f4", 76))
sensed_dtype = _record(24, sensor=("i8", 0), body=("i8", 8), sensor_part=("i4", 16), part=("i4", 20))
joint_dtype = _record(92, force=("(3,)f4", 0), torque=("(3,)f4", 12), max_force=("f4", 24), max_torque=("f4", 28), broken=("?", 84),
                      gap=("f4", 32), coordinates=("(6,)f4", 36), rates=("(6,)f4", 60))
drive_dtype = _record(48, **{name: ("f4", 4 * i) for i, name in enumerate(
    ("stiffness", "damping", "target", "target_speed", "max_force", "motor_speed", "motor_force", "friction", "armature", "lower", "upper"))},
    locked=("?", 44))
vehicle_dtype = _record(40, **{name: ("f4", 4 * i) for i, name in enumerate(("throttle", "brake", "steer", "hand_brake", "speed", "curvature"))},
                        by_route=("?", 32), passed=("i4", 24), next=("i4", 28), arrived=("?", 36))
hit_dtype = _record(40, body=("i8", 0), part=("i4", 8), distance=("f4", 12), point=("(3,)f4", 16), normal=("(3,)f4", 28))
part_dtype = _record(16, body=("i8", 0), part=("i4", 8))
depth_dtype = _record(32, body=("i8", 0), part=("i4", 8), depth=("f4", 12), normal=("(3,)f4", 16))
_joint_axis = _record(92, coordinates=("(6,)f4", 36), rates=("(6,)f4", 60), axis=("u4", 88))
_ray_dtype = np.dtype([("from", "(3,)f4"), ("along", "(3,)f4"), ("reach", "f4"), ("mask", "u4"), ("solid", "u4"), ("copy", "u4")])
_cast_dtype = np.dtype([("from", "(3,)f4"), ("orientation", "(4,)f4"), ("along", "(3,)f4"), ("reach", "f4"), ("mask", "u4"), ("solid", "u4"),
                        ("copy", "u4"), ("ignored", "i8")], align=True)
_placed_dtype = np.dtype([("position", "(3,)f4"), ("orientation", "(4,)f4"), ("mask", "u4"), ("ignored", "i8"), ("copy", "u4")], align=True)
_point_dtype = np.dtype([("point", "(3,)f4"), ("reach", "f4"), ("mask", "u4"), ("copy", "u4")])
_body_dtype = np.dtype([("index", "u4"), ("generation", "u4")])
_pose_dtype = _record(32, position=("(3,)f4", 0), orientation=("(4,)f4", 16))
_velocity_dtype = _record(32, linear=("(3,)f4", 0), angular=("(3,)f4", 16))

_COLUMNS: Dict[str, Tuple[Any, Tuple[int, ...]]] = {
    "position": (np.float32, (3,)), "orientation": (np.float32, (4,)), "velocity": (np.float32, (3,)), "angular_velocity": (np.float32, (3,)),
    "mass": (np.float32, ()), "asleep": (np.bool_, ()), "exists": (np.bool_, ())}
_AXES = ["x", "y", "z", "twist", "swing_y", "swing_z"]


# ---- What goes to the library and comes from it
def _copied(array: Array, kind: Any) -> _Array:
    """Records that the library gave, which end with the thread's next call."""
    dtype = np.dtype(kind)
    if not array.count:
        return np.zeros(0, dtype)
    if array.stride != dtype.itemsize:
        raise RuntimeError(f"libscree has records of {array.stride} bytes, not {dtype.itemsize}: it is of another version than the package")
    made = np.empty(array.count, dtype)
    ctypes.memmove(made.ctypes.data, array.data, made.nbytes)
    return made


def _columns(given: Mapping[bytes, Optional[_Array]], rows: int) -> Tuple[Any, int]:
    """Structs that name arrays without gaps, one row for each thing; these must outlive the call."""
    there = [(name, values) for name, values in given.items() if values is not None]
    made = (Column * len(there))()
    for one, (name, values) in zip(made, there):
        if len(values) != rows or not values.flags.c_contiguous:  # the package has shaped it; this is for those who call past it
            raise ValueError(f"{name.decode()}: has another shape than its bodies or joints")
        one.name, one.data = name, values.ctypes.data
    return made, len(there)


def _text(given: str) -> bytes:
    """UTF-8 that ends at its end, as C has it."""
    if "\0" in given:
        raise ValueError(f"a text has a NUL: {given[:60]!r}")
    return given.encode("utf-8", "surrogateescape")


def _flags_of(mask: Any) -> _Array:
    return np.ascontiguousarray(mask, dtype=np.uint8)


def _given_text(function: Callable[..., int], *arguments: Any) -> str:
    found = ctypes.c_char_p()
    check(function(*arguments, _byref(found)))
    return (found.value or b"").decode()


def _given_array(kind: Any, function: Callable[..., int], *arguments: Any) -> _Array:
    found = Array()
    check(function(*arguments, _byref(found)))
    return _copied(found, kind)


def _three(function: Callable[..., int], *arguments: Any) -> Tuple[float, float, float]:
    made = (ctypes.c_float * 3)()
    check(function(*arguments, made))
    return (made[0], made[1], made[2])


def _triple(values: Any) -> Any:
    return (ctypes.c_float * 3)(*(float(x) for x in values))


class Description:
    """A scene that is being described."""

    def __init__(self, other: "Optional[Description]" = None) -> None:
        handle = ctypes.c_void_p()
        check(LIBRARY.scree_scene_create(_byref(handle)) if other is None else LIBRARY.scree_scene_copy(other._handle, _byref(handle)))
        self._handle: Optional[int] = handle.value

    @classmethod
    def _made(cls, function: Callable[..., int], *arguments: Any) -> "Description":
        handle = ctypes.c_void_p()
        check(function(*arguments, _byref(handle)))
        made = cls.__new__(cls)
        made._handle = handle.value
        return made

    def __del__(self, release: Any = LIBRARY.scree_scene_release) -> None:
        release(getattr(self, "_handle", None))

    def _get(self, key: str) -> Any:
        return json.loads(_given_text(LIBRARY.scree_scene_get, self._handle, key.encode()))

    def _set(self, key: str, value: str) -> None:
        check(LIBRARY.scree_scene_set(self._handle, key.encode(), _text(value)))

    def _add(self, things: str, text: str) -> int:
        index = ctypes.c_size_t()
        check(LIBRARY.scree_scene_add(self._handle, things.encode(), _text(text), _byref(index)))
        return index.value

    def add_bodies(self, body: str, count: int, columns: Dict[str, _Floats]) -> int:
        first = ctypes.c_size_t()
        given, number = _columns({name.encode(): values for name, values in columns.items()}, count)
        check(LIBRARY.scree_scene_add_bodies(self._handle, _text(body), count, given, number, _byref(first)))
        return first.value

    def add_joint(self, joint: str) -> int:
        return self._add("joints", joint)

    def add_vehicle(self, vehicle: str) -> int:
        return self._add("vehicles", vehicle)

    def add_event(self, event: str) -> None:
        self._add("events", event)

    def add_grains(self, grains: str) -> int:
        return self._add("grains", grains)

    def add_bonds(self, bonds: str) -> int:
        return self._add("bonds", bonds)

    def add_servo_wall(self, wall: str) -> int:
        return self._add("servo_walls", wall)

    def add_exclusion(self, a: int, b: int) -> None:
        self._add("exclusions", json.dumps([a, b]))

    def add_car(self, car: str) -> int:
        return self._add("cars", car)

    def add_cart(self, cart: str) -> int:
        return self._add("carts", cart)

    def set_part(self, key: str, value: str) -> None:
        self._set(key, value)

    def indices_of(self, things: str, name: str) -> List[int]:
        return _given_array(np.uint64, LIBRARY.scree_scene_find, self._handle, things.encode(), _text(name)).tolist()  # type: ignore[no-any-return]

    def count(self, things: str) -> int:
        found = ctypes.c_size_t()
        check(LIBRARY.scree_scene_count(self._handle, things.encode(), _byref(found)))
        return found.value

    def names(self, things: str) -> List[str]:
        return self._get(things)  # type: ignore[no-any-return]

    def vehicle_bodies(self, vehicle: int) -> List[int]:
        return _given_array(np.uint64, LIBRARY.scree_scene_vehicle_bodies, self._handle, vehicle).tolist()  # type: ignore[no-any-return]

    def settings(self) -> Dict[str, Any]:
        return self._get("settings")  # type: ignore[no-any-return]

    def camera(self) -> Optional[Dict[str, Any]]:
        return self._get("camera")  # type: ignore[no-any-return]

    def to_json(self) -> str:
        return _given_text(LIBRARY.scree_scene_get, self._handle, b"scene")

    def whole_json(self) -> str:
        return _given_text(LIBRARY.scree_scene_get, self._handle, b"whole")

    def save(self, path: str) -> None:
        check(LIBRARY.scree_scene_save(self._handle, _text(path)))

    def scene_hash(self) -> str:
        found = ctypes.c_uint64()
        check(LIBRARY.scree_scene_hash(self._handle, _byref(found)))
        return f"{found.value:016x}"

    def check(self) -> List[str]:
        return json.loads(_given_text(LIBRARY.scree_scene_check, self._handle))  # type: ignore[no-any-return]

    @property
    def gravity(self) -> Any:
        return tuple(self._get("gravity"))

    @gravity.setter
    def gravity(self, value: _Floats) -> None:
        self._set("gravity", json.dumps([float(x) for x in value]))

    @property
    def duration(self) -> float:
        return float(self._get("duration"))

    @duration.setter
    def duration(self, seconds: float) -> None:
        self._set("duration", json.dumps(float(seconds)))

    @property
    def notes(self) -> List[str]:
        return self._get("notes")  # type: ignore[no-any-return]


class Export:
    """An animation that is recorded from now on."""

    def __init__(self, world: "World", handle: Optional[int]) -> None:
        self._world = world
        self._handle = handle

    def close(self) -> None:
        self._world._close_export(self._handle)


class Recording:
    """A page of the steps from now on."""

    def __init__(self, world: "World", handle: Optional[int]) -> None:
        self._world = world
        self._handle = handle

    def __del__(self, release: Any = LIBRARY.scree_recording_release) -> None:
        release(getattr(self, "_handle", None))

    def _call(self, function: Callable[..., int], *arguments: Any) -> None:
        with self._world._idle():
            check(function(self._handle, *arguments))

    def count(self) -> int:
        found = ctypes.c_uint64()
        self._call(LIBRARY.scree_recording_count, _byref(found))
        return found.value

    def page(self) -> str:
        found = Array()
        with self._world._idle():
            check(LIBRARY.scree_recording_page(self._handle, _byref(found)))
            return ctypes.string_at(found.data, found.count).decode()

    def save(self, path: str) -> None:
        self._call(LIBRARY.scree_recording_save, _text(path))

    def stop(self) -> None:
        self._call(LIBRARY.scree_recording_stop)


class _View:
    """Memory of the library's tables, which an array keeps."""

    def __init__(self, handle: Optional[int], array: Array, kind: Any, world: "World") -> None:
        self._handle = handle
        self._world = world
        dtype = np.dtype(kind)
        self.__array_interface__ = {"version": 3, "shape": (array.count,), "typestr": dtype.str, "descr": dtype.descr,
                                    "data": (array.data or 0, True), "strides": None if array.stride == dtype.itemsize else (array.stride,)}

    def __del__(self, release: Any = LIBRARY.scree_view_release) -> None:
        release(self._handle)


_Result = TypeVar("_Result")
# Steps go in batches of about 20 ms, between which Python hears signals. One that may take longer than a tenth of a second runs on a
# thread of its own, so that Ctrl-C is heard while it runs.
_BATCH, _LONG, _HEARING, _LARGEST = 0.02, 0.1, 0.05, 1024
_BETWEEN_REPORTS = 0.1  # s


class World:
    """A simulation. A step that an interrupt left goes on by itself, and the next call waits for it."""

    def __init__(self, scenes: Sequence[Description], settings: str, backend: str, device: str, threads: int, validate: bool, copies: int) -> None:
        options = sized(WorldOptions, backend=backend.encode(), device=_text(device), settings_json=_text(settings), threads=threads,
                        validate=int(validate), copies=copies)
        handle = ctypes.c_void_p()
        if len(scenes) == 1:
            check(LIBRARY.scree_world_create(scenes[0]._handle, _byref(options), _byref(handle)))
        else:
            handles = (ctypes.c_void_p * len(scenes))(*(one._handle for one in scenes))
            check(LIBRARY.scree_world_create_copies(handles, len(scenes), _byref(options), _byref(handle)))
        self._handle = handle.value
        self._left: Optional[threading.Event] = None  # set when the step aside is done; an interrupted join() would call its thread ended
        self._left_error: Optional[Exception] = None
        self._exports: List[Optional[int]] = []  # handles of those that are recorded
        self._batch = 1
        self._batch_seconds = 1.0  # that the last batch took; at first unknown
        self._stepping = False
        self._calls = threading.RLock()  # steps begin behind a call of another thread, which is short

    def __del__(self, release: Any = LIBRARY.scree_world_release) -> None:
        release(getattr(self, "_handle", None))

    # ---- calls
    def _wait(self) -> None:
        """For steps that an interrupt left."""
        while self._left is not None and not self._left.wait(_HEARING):
            pass
        self._left = None
        error, self._left_error = self._left_error, None
        if error is not None:
            raise error

    @contextlib.contextmanager
    def _idle(self) -> Iterator[None]:
        """While no step runs."""
        with self._calls:
            if self._stepping:
                raise RuntimeError("the world is in use by another thread")
            if self._left is not None:
                self._wait()
            yield

    def _call(self, function: Callable[..., int], *arguments: Any) -> None:
        with self._calls:
            if self._stepping:
                raise RuntimeError("the world is in use by another thread")
            if self._left is not None:
                self._wait()
            result = function(self._handle, *arguments)
            if result:
                raise error_of(result)

    def _array(self, kind: Any, function: Callable[..., int], *arguments: Any) -> _Array:
        found = Array()
        with self._calls:  # the next call may take its place
            self._call(function, *arguments, _byref(found))
            return _copied(found, kind)

    def _text(self, key: bytes) -> bytes:
        found = ctypes.c_char_p()
        with self._calls:
            self._call(LIBRARY.scree_world_get, key, _byref(found))
            return found.value or b"null"

    def _json(self, key: bytes) -> Any:
        return json.loads(self._text(key))

    def _info(self) -> Any:
        info = sized(WorldInfo)
        self._call(LIBRARY.scree_world_get_info, _byref(info))
        return info

    def _count(self, things: bytes) -> int:
        found = ctypes.c_size_t()
        self._call(LIBRARY.scree_world_count, things, _byref(found))
        return found.value

    # ---- stepping
    def step(self, count: int, report: Optional[Callable[[int, int], None]]) -> None:
        if count < 0:
            raise ValueError("step: the number of steps must not be negative")
        with self._calls:
            if self._stepping:
                raise RuntimeError("the world is in use by another thread")
            self._wait()
            self._stepping = True
        try:
            done, reported = 0, time.monotonic()
            while done < count:
                batch = min(self._batch, count - done)
                start = time.perf_counter()
                if self._batch_seconds > _LONG:
                    self._step_aside(batch)
                else:
                    result = LIBRARY.scree_world_step(self._handle, batch, None, None)
                    if result:
                        raise error_of(result)
                seconds = self._batch_seconds = time.perf_counter() - start
                if seconds < 0.5 * _BATCH:
                    self._batch = min(2 * self._batch, _LARGEST)
                elif seconds > 2 * _BATCH:
                    self._batch = max(self._batch // 2, 1)
                done += batch
                if report is not None and done < count and time.monotonic() - reported > _BETWEEN_REPORTS:
                    reported = time.monotonic()
                    report(done, count)
        finally:
            self._stepping = False

    def follow_demo(self, name: Optional[str], bodies: int, seed: int) -> None:
        self._call(LIBRARY.scree_world_follow_demo, None if name is None else _text(name), bodies, seed)

    def _step_aside(self, batch: int) -> None:
        done = threading.Event()

        def work() -> None:
            result = LIBRARY.scree_world_step(self._handle, batch, None, None)
            if result:
                self._left_error = error_of(result)
            done.set()

        self._left = done
        try:
            threading.Thread(target=work, daemon=True).start()
        except RuntimeError:  # no thread can be had
            self._left = None
            raise
        self._wait()

    def is_stepping(self) -> bool:
        return self._left is not None and not self._left.is_set()

    def export_to(self, path: str, every: int, clips: int) -> Export:
        handle = ctypes.c_void_p()
        self._call(LIBRARY.scree_world_export, _text(path), every, clips, _byref(handle))
        self._exports.append(handle.value)
        return Export(self, handle.value)

    def _close_export(self, handle: Optional[int]) -> None:
        self._wait()
        check(LIBRARY.scree_export_close(handle))
        self._exports.remove(handle)

    def close_exports(self) -> None:
        for handle in list(self._exports):
            self._close_export(handle)

    def record(self, title: str, camera: str, look: str, fps: float, copy: Optional[int], contacts: Optional[bool], events: bool) -> Recording:
        handle = ctypes.c_void_p()
        options = sized(RecordOptions, title=_text(title) if title else None, camera_json=_text(camera) if camera else None, look_json=_text(look),
                        fps=fps, copy=ALL_COPIES if copy is None else copy, contacts=0 if contacts is None else 1 if contacts else -1,
                        events=int(events))
        self._call(LIBRARY.scree_world_record, _byref(options), _byref(handle))
        return Recording(self, handle.value)

    # ---- states
    def save(self) -> bytes:
        found = Array()
        self._call(LIBRARY.scree_world_save, _byref(found))
        return ctypes.string_at(found.data, found.count)

    def restore(self, saved: bytes) -> None:
        self._call(LIBRARY.scree_world_restore, saved, len(saved))

    def keep_state(self) -> None:
        self._call(LIBRARY.scree_world_keep_state)

    def roll_back(self, steps: int) -> None:
        self._call(LIBRARY.scree_world_roll_back, steps)

    def kept_states(self) -> List[int]:
        return self._array(np.uint64, LIBRARY.scree_world_kept_states).tolist()  # type: ignore[no-any-return]

    def drop_states(self) -> None:
        self._call(LIBRARY.scree_world_drop_states)

    def snapshot(self, copy: Optional[int] = None) -> Description:
        self._wait()
        return Description._made(LIBRARY.scree_world_snapshot, self._handle, ALL_COPIES if copy is None else copy)

    def write_checkpoint(self, path: str, note: str) -> None:
        self._call(LIBRARY.scree_world_write_checkpoint, _text(path), _text(note))

    def read_checkpoint(self, path: str) -> str:
        found = ctypes.c_char_p()
        self._call(LIBRARY.scree_world_read_checkpoint, _text(path), _byref(found))
        return (found.value or b"").decode()

    # ---- what it tells of itself
    def statistics(self, copy: Optional[int] = None) -> Dict[str, Any]:
        made = sized(Statistics)
        self._call(LIBRARY.scree_world_statistics, ALL_COPIES if copy is None else copy, _byref(made))
        values = ((name, getattr(made, name)) for name, _ in Statistics._fields_ if name != "size")
        return {name: tuple(value) if isinstance(value, ctypes.Array) else value for name, value in values}

    def copies(self) -> int:
        return self._count(b"copies")

    def state_hash(self) -> str:
        found = ctypes.c_uint64()
        self._call(LIBRARY.scree_world_hash, _byref(found))
        return f"{found.value:016x}"

    def state_hashes(self) -> List[str]:
        return [f"{one:016x}" for one in self._array(np.uint64, LIBRARY.scree_world_copy_hashes).tolist()]

    def settings(self) -> Dict[str, Any]:
        return dict(_settings_of(self._text(b"settings")))

    def stage_times(self) -> Dict[str, float]:
        return self._json(b"stage_times")  # type: ignore[no-any-return]

    def set_profiling(self, on: bool) -> None:
        self._call(LIBRARY.scree_world_set, b"profiling", json.dumps(bool(on)).encode())

    @property
    def steps(self) -> int:
        return int(self._info().steps)

    @property
    def time(self) -> float:
        return float(self._info().time)

    @property
    def backend(self) -> str:
        return self._info().backend.decode()  # type: ignore[no-any-return]

    @property
    def device(self) -> str:
        return self._info().device.decode()  # type: ignore[no-any-return]

    @property
    def remark(self) -> str:
        return self._info().remark.decode()  # type: ignore[no-any-return]

    @property
    def buffer_bytes(self) -> int:
        return int(self._info().buffer_bytes)

    @property
    def buffer_growths(self) -> int:
        return int(self._info().buffer_growths)

    def names(self, things: str) -> List[str]:
        return self._json(things.encode())  # type: ignore[no-any-return]

    def indices_of(self, things: str, name: str) -> List[int]:
        return self._array(np.uint64, LIBRARY.scree_world_find, things.encode(), _text(name)).tolist()  # type: ignore[no-any-return]

    # ---- copies
    def reset(self, mask: _Flags) -> None:
        flags = _flags_of(mask)
        self._call(LIBRARY.scree_world_reset, flags.ctypes.data, flags.size)

    def gravity_of(self, copy: int) -> Tuple[float, float, float]:
        made = (ctypes.c_float * 3)()
        self._call(LIBRARY.scree_world_gravity, copy, made)
        return (made[0], made[1], made[2])

    def set_gravity_of(self, copy: int, gravity: Any) -> None:
        self._call(LIBRARY.scree_world_set_gravity, copy, _triple(gravity))

    def cell(self) -> Tuple[Tuple[float, ...], Tuple[float, ...]]:
        size, rate = (ctypes.c_float * 3)(), (ctypes.c_float * 3)()
        self._call(LIBRARY.scree_world_cell, size, rate)
        return tuple(size), tuple(rate)

    @property
    def gravity(self) -> Any:
        return self.gravity_of(ALL_COPIES)

    @gravity.setter
    def gravity(self, value: _Floats) -> None:
        self.set_gravity_of(ALL_COPIES, value)

    def wake_copy(self, copy: int) -> None:
        self._call(LIBRARY.scree_world_wake_copy, copy)

    def wake_all(self) -> None:
        self._call(LIBRARY.scree_world_wake_copy, ALL_COPIES)

    # ---- bodies
    def columns(self, names: Sequence[str]) -> Dict[str, _Array]:
        count = self._count(b"bodies")
        made = {name: np.empty((count, *_COLUMNS[name][1]), _COLUMNS[name][0]) for name in names}
        outputs, number = _columns({name.encode(): values for name, values in made.items()}, count)
        self._call(LIBRARY.scree_world_read, outputs, number, count)
        return made

    def _columns_of(self, ids: _Ids, **widths: int) -> Dict[str, _Floats]:
        made = {name: np.empty((len(ids), width), np.float32) for name, width in widths.items()}
        outputs, number = _columns({name.encode(): values for name, values in made.items()}, len(ids))
        self._call(LIBRARY.scree_world_read_of, ids.ctypes.data, len(ids), outputs, number)
        return made

    def count(self) -> int:
        return self._count(b"bodies")

    def bodies_there(self) -> int:
        return self._count(b"bodies_there")

    def joint_count(self) -> int:
        return self._count(b"joints")

    def _with_rows(self, function: Callable[..., int], ids: _Ids, columns: Dict[bytes, _MaybeFloats], *more: Any, before: Tuple[Any, ...] = ()) -> None:
        count = len(ids)
        given, number = _columns(columns, count)
        self._call(function, ids.ctypes.data, count, *before, given, number, *more)

    def set(self, ids: _Ids, position: _MaybeFloats, orientation: _MaybeFloats, velocity: _MaybeFloats, angular_velocity: _MaybeFloats) -> None:
        self._with_rows(LIBRARY.scree_world_write, ids,
                        {b"position": position, b"orientation": orientation, b"velocity": velocity, b"angular_velocity": angular_velocity})

    def apply(self, ids: _Ids, force: _MaybeFloats, torque: _MaybeFloats, impulse: _MaybeFloats, angular_impulse: _MaybeFloats,
              offset: _MaybeFloats) -> None:
        self._with_rows(LIBRARY.scree_world_apply, ids,
                        {b"force": force, b"torque": torque, b"impulse": impulse, b"angular_impulse": angular_impulse, b"offset": offset})

    def move(self, ids: _Ids, position: _Floats, orientation: _Floats, steps: int) -> None:
        self._with_rows(LIBRARY.scree_world_move, ids, {b"position": position, b"orientation": orientation}, steps)

    def touch_forces(self, ids: _Ids) -> _Floats:
        return self._columns_of(ids, touch_force=3)["touch_force"]

    def origins(self, ids: _Ids) -> Tuple[_Floats, _Floats]:
        made = self._columns_of(ids, origin_position=3, origin_orientation=4)
        return made["origin_position"], made["origin_orientation"]

    def masses(self) -> _Floats:
        return self.columns(["mass"])["mass"]

    def row_of(self, body: int) -> int:
        found = ctypes.c_size_t()
        self._call(LIBRARY.scree_world_row_of, body, _byref(found))
        return found.value

    def table(self, name: str) -> _Array:
        kinds: Dict[str, Any] = {"poses": _pose_dtype, "velocities": _velocity_dtype, "ids": np.uint32}
        handle, rows = ctypes.c_void_p(), Array()
        if self.backend != "cpu":
            raise BufferError(f'the tables of this world are on {self.device}; World.position and the like copy them, and backend="cpu" keeps them here')
        self._call(LIBRARY.scree_world_view, name.encode(), _byref(handle), _byref(rows))
        return np.asarray(_View(handle.value, rows, kinds[name], self))

    @property
    def views(self) -> int:
        found = ctypes.c_size_t()
        self._call(LIBRARY.scree_world_view_count, _byref(found))
        return found.value

    def add(self, bodies: Description) -> _Ids:
        made = self._array(_body_dtype, LIBRARY.scree_world_add_bodies, bodies._handle)
        pairs: _Ids = made.view(np.uint32).reshape(-1, 2).astype(np.int64)
        return pairs

    @staticmethod
    def _handles(given: _Ids) -> _Array:
        if given.ndim != 2 or given.shape[1] != 2:
            raise ValueError("handles: has another shape than its bodies, rays or shapes")
        wrong = ((given < 0) | (given > 0xFFFFFFFF)).any(axis=1)
        if wrong.any():
            raise IndexError(f"body {given[wrong][0, 0]}: no handle of a body")
        made = np.empty(len(given), _body_dtype)
        made["index"], made["generation"] = given[:, 0], given[:, 1]
        return made

    def remove(self, handles: _Ids) -> None:
        given = self._handles(handles)
        self._call(LIBRARY.scree_world_remove_bodies, given.ctypes.data, len(given))

    def handles(self, ids: _Ids) -> _Ids:
        made = np.empty(len(ids), _body_dtype)
        self._call(LIBRARY.scree_world_bodies, ids.ctypes.data, len(ids), made.ctypes.data)
        pairs: _Ids = made.view(np.uint32).reshape(-1, 2).astype(np.int64)
        return pairs

    def are_valid(self, handles: _Ids) -> _Flags:
        given = self._handles(handles)
        made = np.empty(len(given), np.bool_)
        self._call(LIBRARY.scree_world_are_valid, given.ctypes.data, len(given), made.ctypes.data)
        return made

    def wake(self, ids: _Ids) -> None:
        self._call(LIBRARY.scree_world_wake, ids.ctypes.data, len(ids))

    def set_material(self, ids: _Ids, material: str) -> None:
        self._call(LIBRARY.scree_world_set_material, ids.ctypes.data, len(ids), _text(material))

    def _set_body(self, body: int, what: bytes, text: str) -> None:
        self._call(LIBRARY.scree_world_set_body, body, what, _text(text))

    def set_mass(self, body: int, mass: float) -> None:
        self._set_body(body, b"mass", json.dumps(float(mass)))

    def set_filter(self, body: int, filter: str) -> None:
        self._set_body(body, b"filter", filter)

    def set_motion(self, body: int, motion: str) -> None:
        self._set_body(body, b"motion", json.dumps(motion))

    def set_exclusion(self, a: int, b: int, excluded: bool) -> None:
        self._call(LIBRARY.scree_world_set_exclusion, a, b, int(excluded))

    def set_fields(self, fields: str) -> None:
        self._call(LIBRARY.scree_world_set, b"fields", _text(fields))

    def tune(self, what: str, value: Union[int, float, bool, List[float]]) -> None:
        self._call(LIBRARY.scree_world_set, what.encode(), json.dumps(value).encode())

    # ---- contacts and events
    def contacts(self) -> _Array:
        return self._array(contact_dtype, LIBRARY.scree_world_contacts)

    def take_events(self) -> _Array:
        return self._array(event_dtype, LIBRARY.scree_world_take_events)

    def records_events(self) -> bool:
        return bool(self._info().records_events)

    def set_events(self, contacts: bool, hit_speed: float, breaks: bool, sleep: bool, sensors: bool) -> None:
        options = sized(EventOptions, contacts=int(contacts), hit_speed=hit_speed, breaks=int(breaks), sleep=int(sleep), sensors=int(sensors))
        self._call(LIBRARY.scree_world_set_events, _byref(options))

    def sensed(self) -> _Array:
        return self._array(sensed_dtype, LIBRARY.scree_world_sensed)

    # ---- measures
    def set_measures(self, request: Optional[str], copy: int) -> None:
        self._call(LIBRARY.scree_world_set_measures, None if request is None else _text(request), copy)

    def measure(self) -> Tuple[Any, Dict[str, _Array]]:
        """What was measured, and its columns."""
        told = ctypes.c_char_p()
        with self._calls:  # no other measure between these
            self._call(LIBRARY.scree_world_measure, _byref(told))
            about = json.loads(told.value or b"{}")
            columns = {name: self._array(np.dtype("f8"), LIBRARY.scree_world_measured, name.encode()) for name in about["columns"]}
        return about, columns

    # ---- joints and vehicles
    def joints(self) -> _Array:
        return self._array(joint_dtype, LIBRARY.scree_world_joints)

    def joint_motions(self) -> Tuple[_Floats, _Floats]:
        """Coordinates and rates along or about the axis on which each joint moves."""
        states = self._array(_joint_axis, LIBRARY.scree_world_joints)
        rows = np.arange(len(states))
        return states["coordinates"][rows, states["axis"]], states["rates"][rows, states["axis"]]

    def drives(self, axis: int) -> _Array:
        return self._array(drive_dtype, LIBRARY.scree_world_drives, axis)

    @staticmethod
    def _axis(name: str) -> int:
        if name and name not in _AXES:
            raise ValueError(f'unknown axis "{name}"; known: {", ".join(_AXES)}')
        return _AXES.index(name) if name else -1

    def set_motors(self, joints: _Ids, axis: str, speed: _Floats, max_force: _Floats) -> None:
        self._with_rows(LIBRARY.scree_world_set_motors, joints, {b"speed": speed, b"max_force": max_force}, before=(self._axis(axis),))

    def set_springs(self, joints: _Ids, axis: str, spring: str) -> None:
        self._call(LIBRARY.scree_world_set_springs, joints.ctypes.data, len(joints), self._axis(axis), _text(spring))

    def set_drives(self, joints: _Ids, axis: str, stiffness: _MaybeFloats, damping: _MaybeFloats, target: _MaybeFloats,
                   target_speed: _MaybeFloats, max_force: _MaybeFloats) -> None:
        self._with_rows(LIBRARY.scree_world_set_drives, joints,
                        {b"stiffness": stiffness, b"damping": damping, b"target": target, b"target_speed": target_speed, b"max_force": max_force},
                        before=(self._axis(axis),))

    def set_joint_coordinates(self, joints: _Ids, axis: str, coordinate: _MaybeFloats, rate: _MaybeFloats) -> None:
        self._with_rows(LIBRARY.scree_world_set_joint_coordinates, joints, {b"coordinate": coordinate, b"rate": rate}, before=(self._axis(axis),))

    def apply_joint_forces(self, joints: _Ids, axis: str, force: _Floats) -> None:
        self._with_rows(LIBRARY.scree_world_apply_joint_forces, joints, {b"force": force}, before=(self._axis(axis),))

    def add_joint(self, joint: str, anchor: _MaybeFloats, axis: _Floats) -> int:
        index = ctypes.c_size_t()
        place = (None, None) if anchor is None else (_triple(anchor), _triple(axis))
        self._call(LIBRARY.scree_world_add_joint, _text(joint), *place, _byref(index))
        return index.value

    def remove_joint(self, joint: int) -> None:
        self._call(LIBRARY.scree_world_remove_joint, joint)

    def vehicles(self) -> _Array:
        return self._array(vehicle_dtype, LIBRARY.scree_world_vehicles)

    def drive(self, vehicle: int, throttle: float, brake: float, steer: float, hand_brake: float) -> None:
        self._call(LIBRARY.scree_world_drive, vehicle, throttle, brake, steer, hand_brake)

    def drive_by_route(self, vehicle: int) -> None:
        self._call(LIBRARY.scree_world_drive_by_route, vehicle)

    def reset_upright(self, vehicle: int) -> None:
        self._call(LIBRARY.scree_world_reset_upright, vehicle)

    # ---- what acts on bodies
    def grip(self, body: int, anchor: _Floats, target: _Floats, hertz: float, damping_ratio: float, max_acceleration: float,
             spin_damping: float) -> int:
        options = sized(GripOptions, hertz=hertz, damping_ratio=damping_ratio, max_acceleration=max_acceleration, spin_damping=spin_damping)
        found = ctypes.c_size_t()
        self._call(LIBRARY.scree_world_grip, body, _triple(anchor), _triple(target), _byref(options), _byref(found))
        return found.value

    def move_grip(self, grip: int, target: _Floats) -> None:
        self._call(LIBRARY.scree_world_move_grip, grip, _triple(target))

    def release(self, grip: int) -> None:
        self._call(LIBRARY.scree_world_release_grip, grip)

    def explode(self, centre: _Floats, radius: float, speed: float) -> None:
        self._call(LIBRARY.scree_world_explode, _triple(centre), radius, speed)

    # ---- queries
    @staticmethod
    def _rays(origins: _Floats, directions: _Floats, reach: _Floats, mask: int, solid: bool, copies: _Ids) -> _Array:
        rays = np.empty(len(origins), _ray_dtype)
        rays["from"], rays["along"], rays["reach"] = origins, directions, reach
        rays["mask"], rays["solid"], rays["copy"] = mask, solid, _one_or_each(copies, len(rays), "copy")
        return rays

    def _hits(self, function: Callable[..., int], queries: _Array, before: Tuple[Any, ...] = ()) -> _Array:
        hits = np.empty(len(queries), hit_dtype)
        self._call(function, *before, queries.ctypes.data, len(queries), queries.itemsize, hits.ctypes.data, hits.itemsize)
        return hits

    def _lists(self, kind: Any, function: Callable[..., int], queries: _Array, before: Tuple[Any, ...] = ()) -> Tuple[_Ids, _Array]:
        starts, found = np.empty(len(queries) + 1, np.int64), Array()
        self._call(function, *before, queries.ctypes.data, len(queries), queries.itemsize, starts.ctypes.data, _byref(found))
        return starts, _copied(found, kind)

    def cast_rays(self, *rays: Any) -> _Array:
        return self._hits(LIBRARY.scree_world_cast_rays, self._rays(*rays))

    def rays_hit(self, *rays: Any) -> _Flags:
        given = self._rays(*rays)
        made = np.empty(len(given), np.bool_)
        self._call(LIBRARY.scree_world_rays_hit, given.ctypes.data, len(given), given.itemsize, made.ctypes.data)
        return made

    def cast_rays_through(self, *rays: Any) -> Tuple[_Ids, _Array]:
        return self._lists(hit_dtype, LIBRARY.scree_world_cast_rays_through, self._rays(*rays))

    def cast_shapes(self, shape: str, origins: _Floats, directions: _Floats, orientation: _Floats, reach: _Floats, mask: int, copies: _Ids,
                    solid: bool, ignored: _Ids) -> _Array:
        casts = np.empty(len(origins), _cast_dtype)
        casts["from"], casts["along"], casts["orientation"], casts["reach"] = origins, directions, orientation, reach
        casts["mask"], casts["solid"] = mask, solid
        casts["copy"], casts["ignored"] = _one_or_each(copies, len(casts), "copy"), _one_or_each(ignored, len(casts), "ignore")
        return self._hits(LIBRARY.scree_world_cast_shapes, casts, (_text(shape),))

    def closest_points(self, points: _Floats, reach: _Floats, mask: int, copies: _Ids) -> _Array:
        given = np.empty(len(points), _point_dtype)
        given["point"], given["reach"], given["mask"], given["copy"] = points, reach, mask, _one_or_each(copies, len(points), "copy")
        return self._hits(LIBRARY.scree_world_closest_points, given)

    @staticmethod
    def _placed(positions: _Floats, orientation: _Floats, mask: int, copies: _Ids, ignored: _Ids) -> _Array:
        placed = np.empty(len(positions), _placed_dtype)
        placed["position"], placed["orientation"], placed["mask"] = positions, orientation, mask
        placed["copy"], placed["ignored"] = _one_or_each(copies, len(placed), "copy"), _one_or_each(ignored, len(placed), "ignore")
        return placed

    def overlaps(self, shape: str, *placed: Any) -> Tuple[_Ids, _Array]:
        return self._lists(part_dtype, LIBRARY.scree_world_overlaps, self._placed(*placed), (_text(shape),))

    def penetrations(self, shape: str, *placed: Any) -> Tuple[_Ids, _Array]:
        return self._lists(depth_dtype, LIBRARY.scree_world_penetrations, self._placed(*placed), (_text(shape),))

    # ---- pictures
    def debug_drawing(self, ids: Optional[_Ids], shapes: bool, contacts: bool, joints: bool, boxes: bool, segments: int, line_length: float,
                      force_length: float) -> Tuple[_Floats, _Floats, _Floats, _Floats]:
        options = sized(DebugOptions, shapes=int(shapes), contacts=int(contacts), joints=int(joints), boxes=int(boxes), segments=segments,
                        line_length=line_length, force_length=force_length)
        if ids is not None:
            options.bodies, options.body_count = ids.ctypes.data, len(ids)
        lines, dots = Array(), Array()
        self._call(LIBRARY.scree_world_debug_drawing, _byref(options), _byref(lines), _byref(dots))
        line = _copied(lines, np.dtype("(9,)f4")).reshape(-1, 9)
        dot = _copied(dots, np.dtype("(6,)f4")).reshape(-1, 6)
        return (np.ascontiguousarray(line[:, :6]).reshape(-1, 2, 3), np.ascontiguousarray(line[:, 6:]), np.ascontiguousarray(dot[:, :3]),
                np.ascontiguousarray(dot[:, 3:]))

    def render(self, camera: str, width: int, height: int, channels: List[str], look: str, camera_before: str, seconds_before: float,
               copy: Optional[int]) -> Dict[str, _Array]:
        kinds: Dict[str, Tuple[Any, Tuple[int, ...]]] = {
            "color": (np.uint8, (3,)), "depth": (np.float32, ()), "body": (np.int32, ()), "part": (np.int32, ()), "normal": (np.float32, (3,)),
            "flow": (np.float32, (2,))}
        if not (1 <= width <= 16384 and 1 <= height <= 16384):
            raise ValueError("size: each side must be between 1 and 16384 pixels")
        made = {name: np.empty((height, width, *kinds[name][1]), kinds[name][0]) for name in kinds if name in channels}
        options = sized(PictureOptions, width=width, height=height, camera_json=_text(camera), look_json=_text(look),
                        camera_before_json=_text(camera_before) if camera_before else None, seconds_before=seconds_before,
                        copy=ALL_COPIES if copy is None else copy, **{name: array.ctypes.data for name, array in made.items()})
        self._call(LIBRARY.scree_world_render, _byref(options))
        return made

    def canvas_name(self) -> str:
        found = ctypes.c_char_p()
        self._call(LIBRARY.scree_world_canvas_name, _byref(found))
        return (found.value or b"").decode()

    def suggested_camera(self) -> Tuple[Any, Any, float, bool]:
        found = ctypes.c_char_p()
        self._call(LIBRARY.scree_world_suggested_camera, _byref(found))
        camera = json.loads(found.value or b"{}")
        return tuple(camera["eye"]), tuple(camera["target"]), camera["vertical_fov"], camera.get("orthographic", False)


@functools.lru_cache(maxsize=64)
def _settings_of(text: bytes) -> Dict[str, Any]:
    return json.loads(text)  # type: ignore[no-any-return]


def _one_or_each(given: _Ids, n: int, name: str) -> Any:
    """One number for all, or one for each."""
    if given.size == 1:
        one = int(given.reshape(-1)[0])
        if name == "copy" and one < 0:
            raise IndexError(f"copy {one}")
        return one
    if name == "copy" and (given < 0).any():
        raise IndexError(f"copy {given.min()}")
    if given.shape != (n,):
        raise ValueError(f"{name}: has the shape {given.shape}, should have ({n},)")
    return given


# ---- what is not of one scene or world
def is_import(path: str) -> bool:
    found = ctypes.c_int()
    check(LIBRARY.scree_is_import(_text(path), _byref(found)))
    return bool(found.value)


def load(path: str, strict: bool, axes: str, base: str, ground: bool, keyframe: str, packages: Dict[str, str], allow_outside: bool) -> Description:
    if axes not in ("y-up", "file"):
        raise ValueError(f'axes: is "{axes}"; known: y-up, file')
    options = sized(LoadOptions, strict=int(strict), file_axes=int(axes == "file"), ground=int(ground), allow_outside=int(allow_outside),
                    base=_text(base), keyframe=_text(keyframe), packages_json=_text(json.dumps(packages)))
    return Description._made(LIBRARY.scree_scene_load, _text(path), _byref(options))


def from_json(text: str) -> Description:
    return Description._made(LIBRARY.scree_scene_from_json, _text(text))


def demo(name: str, bodies: int, seed: int) -> Description:
    try:
        return Description._made(LIBRARY.scree_scene_demo, _text(name), bodies, seed)
    except ValueError:
        if name in dict(demo_names()):
            raise
        raise KeyError(name) from None


def _describe(what: str, name: Optional[str] = None) -> str:
    return _given_text(LIBRARY.scree_describe, what.encode(), None if name is None else name.encode())


def demo_names() -> List[Tuple[str, str]]:
    return [(name, line) for name, line in json.loads(_describe("demos"))]


@functools.lru_cache(maxsize=None)
def keys(name: str) -> Tuple[str, ...]:
    return tuple(json.loads(_describe("keys", name)))


def schema() -> str:
    return _describe("schema")


def default_settings() -> Dict[str, Any]:
    return json.loads(_describe("settings"))  # type: ignore[no-any-return]


def mass_properties(body: str, density: float) -> Tuple[float, Tuple[float, float, float]]:
    mass, inertia = ctypes.c_float(), (ctypes.c_float * 3)()
    check(LIBRARY.scree_mass_properties(_text(body), density, _byref(mass), inertia))
    return mass.value, (inertia[0], inertia[1], inertia[2])


def png(pixels: _Array) -> bytes:
    wide = pixels.dtype.itemsize == 2
    values = np.ascontiguousarray(pixels, dtype=np.uint16 if wide else np.uint8)
    found = Array()
    check(LIBRARY.scree_png(values.ctypes.data, values.shape[1], values.shape[0], values.shape[2] if values.ndim == 3 else 1, 16 if wide else 8,
                            _byref(found)))
    return ctypes.string_at(found.data, found.count)


def pixel_rays(camera: str, width: int, height: int) -> Tuple[_Floats, _Floats]:
    if width < 1 or height < 1:
        raise ValueError("size: each side must be at least 1 pixel")
    start, along = np.empty((height, width, 3), np.float32), np.empty((height, width, 3), np.float32)
    check(LIBRARY.scree_pixel_rays(_text(camera), width, height, start.ctypes.data, along.ctypes.data))
    return start, along


def close_backends() -> None:
    LIBRARY.scree_close_devices()
