# Worlds: simulations of scenes.
"""Worlds: simulations of scenes, on the CPU or on a Vulkan device, with the same bits."""
from __future__ import annotations

import atexit
import os
import sys
import typing
import weakref
from enum import IntEnum
from typing import Any, Dict, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from scree import _native, _progress
from scree._arrays import (Bodies, Floats, Ids, count_of, each, floats, ids_of, index, index_by_name, json_text, maybe_vectors,
                           number, require_keys, require_some, rotated, triple, turned, unit, vectors, whole)
from scree.camera import Camera, Picture, Size
from scree.joints import JointKind, Spring
from scree.measures import Measures
from scree.recording import Recording, View
from scree.scene import Scene, load
from scree.shapes import Filter, Shape, Vector

Array = npt.NDArray[Any]
ALL_CATEGORIES = 0xFFFFFFFF
_AXES = ("x", "y", "z", "twist", "swing_y", "swing_z")
CHANNELS = ("color", "depth", "body", "part", "normal", "flow")
_LOOK = ("color_map", "color_scale", "color_range", "show", "sky", "sun_azimuth", "sun_elevation", "caption", "canvas", "legend", "shadows", "samples")


class EventKind(IntEnum):
    """What an event tells of."""

    begin = 0  # two parts press on each other, as they did not before
    end = 1  # they are apart, or one of them is gone
    hit = 2  # they pressed on each other faster than hit_speed
    body_broke = 3
    joint_broke = 4
    fell_asleep = 5
    woke = 6
    sensor_begin = 7  # b began to overlap the sensor a
    sensor_end = 8
    bond_broke = 9


class DebugDrawing(typing.NamedTuple):
    """Lines and points of a world, in m, with colours in sRGB, 0 to 1."""
    lines: Floats  # (n, 2, 3): from and to
    line_colors: Floats  # (n, 3)
    points: Floats  # (m, 3)
    point_colors: Floats  # (m, 3)


def _fixed(array: Array) -> Array:
    """An array that is a copy, and cannot be taken for the state itself."""
    array.flags.writeable = False
    return array


def _mask(mask: Any) -> int:
    return count_of(mask, "mask", ALL_CATEGORIES)


class Tables:
    """Read-only views into the simulator's own tables, without a copy; of worlds on the CPU.

    Row order: bodies may be moved in memory between steps, and `ids` tells which is in which row (rows behind the bodies are
    parts). Steps change what a view shows. While a view lives, bodies cannot be added or removed nor a state be restored:
    BufferError. Copies, and gathers such as poses["position"][rows], are free of that.
    """

    def __init__(self, native: "_native.World") -> None:
        self._native = native

    @property
    def poses(self) -> Array:
        """(rows,): position (3,), m, and orientation (4,), x, y, z, w."""
        return self._native.table("poses")

    @property
    def velocities(self) -> Array:
        """(rows,): linear (3,), m/s, and angular (3,), rad/s."""
        return self._native.table("velocities")

    @property
    def ids(self) -> npt.NDArray[np.uint32]:
        """(rows,): the id of the body in each row."""
        return self._native.table("ids")


class Export:
    """An animation that is being recorded; see World.export."""

    def __init__(self, native: Optional["_native.Export"]) -> None:
        self._native = native

    def close(self) -> None:
        """Writes the file with all that was recorded; later steps are not."""
        if self._native is not None:
            self._native.close()
        self._native = None

    def __enter__(self) -> "Export":
        return self

    def __exit__(self, *error: object) -> None:
        self.close()


_worlds: "weakref.WeakSet[World]" = weakref.WeakSet()


def _finish() -> None:
    """Before Python ends: animations are written, and devices closed while their drivers are still there."""
    interrupted = getattr(sys, "last_type", None) is KeyboardInterrupt
    for world in list(_worlds):
        if interrupted and world._native.is_stepping():
            return  # Python ends itself by the signal, and need not wait for a long step
        world._native.close_exports()
    _native.close_backends()


atexit.register(_finish)


def _are_names(joints: Any) -> bool:
    """Whether joints are told by name: one, or a sequence in which there are names."""
    return isinstance(joints, str) or (isinstance(joints, (list, tuple, np.ndarray)) and any(isinstance(one, str) for one in joints))


class World(Bodies[_native.World]):
    """A simulation of a scene.

    scene: a Scene, or the path of a scene file. backend: "auto" (a GPU, else what is faster here), "cpu" or "vulkan"; device:
    which, by index or part of its name. threads: of the CPU, 0: one per core. No result depends on any of them.
    rate: steps per second; substeps: of each step; these and every further setting (sleeping, sleep_speed, friction_factor,
    least_restitution, ...) override those of the scene. events: True, or a dict of set_events().

    Bodies are named by their ids, which Scene.add and World.add return; arrays are in the order of ids.

    copies: many copies of the scene at once, each with the same bits as a world of it alone. Or a list of scenes, one for each
    copy, which differ in values (poses, masses, friction, gravity, ...) and not in the number of bodies and joints. Arrays of
    all bodies are then (copies, n, ...), and ids() gives the ids of bodies in copies.
    Raises SceneError (a ValueError with a `pointer`), and DeviceError where the backend is not to be had.
    """

    __slots__ = ("_copies", "_native", "_told_of_events", "__weakref__")

    def __init__(self, scene: Union[Scene, str, "os.PathLike[str]", typing.Sequence[Scene]], backend: str = "auto",
                 rate: Optional[float] = None, substeps: Optional[int] = None, *, copies: Optional[int] = None, device: str = "",
                 threads: int = 0, validate: bool = False, events: Union[bool, typing.Mapping[str, Any]] = False,
                 **settings: Any) -> None:
        require_keys(settings, _native.keys("settings"), "World")
        if backend not in ("auto", "cpu", "vulkan"):
            raise ValueError(f'backend: unknown "{backend}"; known: auto, cpu, vulkan')
        threads = count_of(threads, "threads")
        if rate is not None:
            settings["rate"] = rate
        if substeps is not None:
            settings["substeps"] = substeps
        if isinstance(scene, (list, tuple)):
            scenes = list(scene)
            if not scenes or copies not in (None, len(scenes)):
                raise ValueError(f"copies: {len(scenes)} scenes are given, one for each copy, not {copies}")
            copies = len(scenes)
        elif not isinstance(scene, (Scene, str, os.PathLike)):
            raise TypeError(f"World: simulates a Scene, a scene file or a list of scenes, not {type(scene).__name__}")
        else:
            scenes = [scene if isinstance(scene, Scene) else load(scene)]
        if copies is not None and whole(copies, "copies") < 1:
            raise ValueError(f"copies: must be at least 1, is {copies}")
        self._copies = copies
        self._native = _native.World([one._native for one in scenes], json_text(settings, "/settings"), backend, str(device), threads,
                                     validate, copies or 0)
        self._told_of_events = False
        _worlds.add(self)
        if events:
            self.set_events(**(events if isinstance(events, typing.Mapping) else {}))

    # ---- running
    def step(self, count: int = 1, progress: Optional[bool] = None) -> None:
        """Advances by `count` steps of 1/rate seconds, without holding Python's lock; Ctrl-C ends it between steps, or
        leaves a long step to end by itself, for which the world's next use waits.

        The scene's timed events happen on the way. progress: shows a bar; by default on a terminal and in a notebook, if it
        takes more than half a second. Raises MemoryError when memory ends.
        """
        count = count_of(count, "the number of steps")
        if count == 1 or not _progress.is_wanted(progress):
            self._native.step(count, None)
            return
        bar = _progress.Bar()
        try:
            self._native.step(count, bar)
        finally:
            bar.close()

    def follow_demo(self, name: Optional[str], bodies: int = 0, seed: int = 1) -> None:
        """Later steps perform what the program does in a run of this demo and is no part of its scene: the bodies of "fountain" are
        born and go. None: nothing any more."""
        self._native.follow_demo(name, count_of(bodies, "bodies"), count_of(seed, "seed"))

    def run(self, seconds: float, progress: Optional[bool] = None) -> None:
        """Advances to the step nearest to that many seconds from now."""
        self.step(round(number(seconds, "seconds") * self.settings["rate"]), progress)

    @property
    def steps(self) -> int:
        """Steps done."""
        return self._native.steps

    @property
    def time(self) -> float:
        """Simulated time, s."""
        return self._native.time

    @property
    def backend(self) -> str:
        """"cpu" or "vulkan"."""
        return self._native.backend

    @property
    def device(self) -> str:
        """The device or the threads that simulate, for messages."""
        return self._native.device

    @property
    def remark(self) -> str:
        """Why backend="auto" chose what it chose, where that may surprise; else empty."""
        return self._native.remark

    @property
    def settings(self) -> Dict[str, Any]:
        """The present settings, as a copy."""
        return self._native.settings()

    @property
    def statistics(self) -> Dict[str, Any]:
        """Sums and extremes over the world, as in reports: kinetic_energy (J), momentum (3,), penetration_max (m), asleep..."""
        return self._native.statistics()

    def state_hash(self) -> str:
        """16 hexadecimal digits that name the state, equal on every backend, and equal to "state_hash" in reports."""
        return self._native.state_hash()

    # ---- bodies, in the order of ids
    def __len__(self) -> int:
        """The number of ids: bodies, and fragments whether they exist yet or not."""
        return self._native.count()

    @property
    def names(self) -> typing.List[str]:
        """The names of the bodies of the scene, by id; "" without one."""
        return self._native.names("bodies")

    def _shaped(self, column: Array) -> Array:
        return _fixed(column if self._copies is None else column.reshape(self._copies, -1, *column.shape[1:]))

    def _column(self, name: str) -> Array:
        return self._shaped(self._native.columns([name])[name])

    @property
    def position(self) -> Floats:
        """(n, 3), m, of the centres of mass: a copy, as all below, and read-only; set() changes them."""
        return self._column("position")

    @property
    def orientation(self) -> Floats:
        """(n, 4), unit quaternions x, y, z, w."""
        return self._column("orientation")

    @property
    def velocity(self) -> Floats:
        """(n, 3), m/s."""
        return self._column("velocity")

    @property
    def angular_velocity(self) -> Floats:
        """(n, 3), rad/s, world axes."""
        return self._column("angular_velocity")

    @property
    def asleep(self) -> npt.NDArray[np.bool_]:
        """(n,)."""
        return self._column("asleep")

    @property
    def exists(self) -> npt.NDArray[np.bool_]:
        """(n,): False for what has broken or was removed, and for fragments of what is still whole."""
        return self._column("exists")

    @property
    def mass(self) -> Floats:
        """(n,), kg, also of what does not move; 0 of planes, meshes and height fields. set_mass() changes it."""
        return self._shaped(self._native.masses())

    def origin(self, ids: Optional[Any] = None) -> Tuple[Floats, Floats]:
        """Positions (n, 3), m, and orientations (n, 4) of the frames in which bodies were described.

        That of the points of a hull, the parts of a compound, the link of a robot, where `position` is the centre of mass and
        `orientation` that of the principal axes. ids: as of set(), with the shape of the ids; without: of all.
        """
        named, shape = self._flat(self.ids() if ids is None and self._copies is not None else
                                  np.arange(len(self)) if ids is None else ids)
        position, orientation = self._native.origins(named)
        return position.reshape(*shape, 3), orientation.reshape(*shape, 4)

    def read(self, *names: str) -> Dict[str, Array]:
        """Several of the above by name, in one transfer from a device; without names all."""
        known = ("position", "orientation", "velocity", "angular_velocity", "asleep", "exists")
        for name in names:
            if name not in known:
                of_joints = name in (self._native.joints().dtype.names or ())
                raise KeyError(f'read: no column of bodies is named "{name}"; ' + (
                    f"joints().{name} is of joints" if of_joints else f"known: {', '.join(known)}"))
        wanted = list(names or known)
        return {name: self._shaped(column) for name, column in self._native.columns(wanted).items()}

    # ---- copies of the scene
    @property
    def copies(self) -> int:
        """Copies of the scene: 1 for a world of a scene alone."""
        return self._native.copies()

    def ids(self, bodies: Any = None, copies: Any = None) -> Ids:
        """(copies, bodies): the ids, in this world, of bodies of the scene in copies; without arguments of all."""
        each = len(self) // self.copies
        body = np.arange(each) if bodies is None else ids_of(bodies, each)
        copy = np.arange(self.copies) if copies is None else ids_of(copies, self.copies, "copies")
        for name, given, most in (("body", body, each), ("copy", copy, self.copies)):
            if given.size and (given.min() < 0 or given.max() >= most):
                raise IndexError(f"{name} {given.max() if given.max() >= most else given.min()} of {most}")
        made: Ids = copy[:, None].astype(np.int64) * each + body[None, :]
        return made

    def reset(self, copies: Optional[Any] = None) -> None:
        """Puts copies (a mask, or their numbers; all without) back to their start, as if they began with the next step.

        Poses, velocities, contacts, sleep, breaks, joints, vehicles; materials, masses, motors and gravity stay as they are set.
        """
        mask = np.zeros(self.copies, dtype=bool)
        which = np.arange(self.copies) if copies is None else np.asarray(copies)
        if which.dtype == np.bool_:
            if which.shape != mask.shape:
                raise ValueError(f"reset: a mask of the shape {which.shape} for {self.copies} copies")
            mask = which.copy()
        else:
            mask[ids_of(which, self.copies, "copies")] = True
        self._native.reset(mask)

    def state_hashes(self) -> typing.List[str]:
        """Of each copy state_hash() of the scene alone."""
        return self._native.state_hashes()

    def statistics_of(self, copy: int) -> Dict[str, Any]:
        """statistics of one copy."""
        return self._native.statistics(index(copy, "copy"))

    def gravity_of(self, copy: int) -> Tuple[float, float, float]:
        """(3,), m/s^2."""
        return self._native.gravity_of(index(copy, "copy"))

    def set_gravity_of(self, copy: int, gravity: Vector) -> None:
        """(3,), m/s^2, of one copy from the next step on, which wakes it."""
        x, y, z = triple(gravity, "gravity")
        self._native.set_gravity_of(index(copy, "copy"), (float(x), float(y), float(z)))

    def wake_copy(self, copy: int) -> None:
        """Wakes all bodies of a copy in the next step."""
        self._native.wake_copy(index(copy, "copy"))

    def _flat(self, ids: Any) -> Tuple[Ids, Tuple[int, ...]]:
        """Ids one after the other, and their shape: (n,), or (copies, k)."""
        array = np.asarray(ids)
        if array.ndim != 2 or array.size == 0:
            named = ids_of(array, len(self))
            return named, named.shape
        named, _ = self._in_a_row(array, ())
        return named, named.shape if array.dtype == np.bool_ else array.shape

    def _in_a_row(self, ids: Any, values: Tuple[Optional[Any], ...]) -> Tuple[Ids, typing.List[Optional[Any]]]:
        """Ids of (copies, k), and their values, one after the other; others as they are."""
        array = np.asarray(ids)
        if array.ndim != 2 or array.size == 0:
            return ids_of(array, len(self)), list(values)
        shape = array.shape
        if array.dtype == np.bool_:
            if shape != (self.copies, len(self) // self.copies):
                raise IndexError(f"ids: a mask of the shape {shape} for {self.copies} copies of {len(self) // self.copies} bodies")
            return ids_of(array.reshape(-1), len(self)), list(values)

        def flat(value: Optional[Any]) -> Optional[Any]:
            if value is None:
                return None
            wide = floats(value, "values")
            try:
                return np.broadcast_to(wide, (*shape, wide.shape[-1])).reshape(-1, wide.shape[-1])
            except (ValueError, IndexError):
                raise ValueError(f"has the shape {wide.shape}, for ids of the shape {shape}") from None

        return ids_of(array.reshape(-1), len(self)), [flat(value) for value in values]

    @property
    def tables(self) -> Tables:
        """Views without a copy; see Tables."""
        return Tables(self._native)

    def set(self, ids: Any, *, position: Optional[Any] = None, orientation: Optional[Any] = None, velocity: Optional[Any] = None,
            angular_velocity: Optional[Any] = None) -> None:
        """Sets poses and velocities of many bodies in one transfer: (n, 3) and (n, 4), or one row for all.

        ids: (n,), one id, a mask of all bodies, or (copies, k) as of ids(), with values (copies, k, 3). Bodies wake. The velocity of
        a kinematic body changes evenly over the next step. Raises IndexError for an id or a mask of another length, ValueError for a body that is
        not there and for values out of range, and then changes nothing.
        """
        require_some("set", position=position, orientation=orientation, velocity=velocity, angular_velocity=angular_velocity)
        named, (position, orientation, velocity, angular_velocity) = self._in_a_row(
            ids, (position, orientation, velocity, angular_velocity))
        n = len(named)
        self._native.set(named, maybe_vectors(position, n, 3, "position"), maybe_vectors(orientation, n, 4, "orientation"),
                         maybe_vectors(velocity, n, 3, "velocity"),
                         maybe_vectors(angular_velocity, n, 3, "angular_velocity"))

    def set_origin(self, ids: Any, position: Optional[Any] = None, orientation: Optional[Any] = None) -> None:
        """Places bodies as Scene.add does, and origin() tells: (n, 3) and (n, 4) of the frames in which they were described."""
        require_some("set_origin", position=position, orientation=orientation)
        named, (position, orientation) = self._in_a_row(ids, (position, orientation))
        at, turn = (one.astype(np.float64) for one in self._native.origins(named))
        now = self._native.columns(["position", "orientation"])
        back = turn * (-1, -1, -1, 1)
        offset = rotated(back, now["position"][named].astype(np.float64) - at)
        within = turned(back, now["orientation"][named].astype(np.float64))
        if position is not None:
            at = vectors(position, len(named), 3, "position").astype(np.float64)
        if orientation is not None:
            turn = unit(vectors(orientation, len(named), 4, "orientation"), "orientation").astype(np.float64)
        self._native.set(named, (at + rotated(turn, offset)).astype(np.float32), turned(turn, within).astype(np.float32), None, None)

    def apply(self, ids: Any, *, force: Optional[Any] = None, torque: Optional[Any] = None, impulse: Optional[Any] = None,
              angular_impulse: Optional[Any] = None, offset: Optional[Any] = None) -> None:
        """Forces (N), torques (N m), impulses (N s) and angular impulses (N m s) on dynamic bodies, in the next step.

        Each is (n, 3), or one row for all; offset, m, from the centre of mass, is where forces and impulses act. Calls add up.
        """
        require_some("apply", force=force, torque=torque, impulse=impulse, angular_impulse=angular_impulse)
        named, (force, torque, impulse, angular_impulse, offset) = self._in_a_row(
            ids, (force, torque, impulse, angular_impulse, offset))
        n = len(named)
        self._native.apply(named, maybe_vectors(force, n, 3, "force"), maybe_vectors(torque, n, 3, "torque"),
                           maybe_vectors(impulse, n, 3, "impulse"), maybe_vectors(angular_impulse, n, 3, "angular_impulse"),
                           maybe_vectors(offset, n, 3, "offset"))

    def add(self, shape: Shape, position: Optional[Any] = None, **fields: Any) -> Any:
        """Adds bodies while the world runs, described as in Scene.add; returns the id, or the ids of many.

        Fragments of breakable bodies follow each; an id that was removed is given again. handles() name bodies for good.
        """
        described = Scene()
        made = described.add(shape, position, **fields)
        handles = self._native.add(described._native)
        return int(handles[0, 0]) if np.ndim(made) == 0 else handles[:, 0].copy()

    def remove(self, bodies: Any) -> None:
        """Removes bodies by ids, or by handles, (n, 2). With them go their joints. Raises IndexError for what is gone."""
        handles = np.asarray(bodies)
        if handles.ndim != 2:
            handles = self.handles(bodies)
        self._native.remove(np.ascontiguousarray(handles, dtype=np.int64))

    def handles(self, ids: Any) -> Ids:
        """(n, 2): id and generation, which name a body for its whole life, while its id may be given to another one."""
        return self._native.handles(ids_of(ids, len(self)))

    def are_valid(self, handles: Any) -> npt.NDArray[np.bool_]:
        """(n,): whether the bodies of (n, 2) handles have not been removed."""
        return self._native.are_valid(np.ascontiguousarray(handles, dtype=np.int64))

    def wake(self, ids: Optional[Any] = None) -> None:
        """Wakes bodies, or all, in the next step."""
        if ids is None:
            self._native.wake_all()
        else:
            self._native.wake(self._flat(ids)[0])

    def set_material(self, ids: Any, **fields: Any) -> None:
        """Changes friction, restitution, rolling_resistance and the like from the next step on; what is not given stays."""
        require_keys(fields, _native.keys("material"), "a material")
        self._native.set_material(self._flat(ids)[0], json_text(fields, "/material"))

    def set_mass(self, ids: Any, mass: Any) -> None:
        """Changes masses, kg (one for all, or one each), and moments of inertia in proportion, from the next step on."""
        named, shape = self._flat(ids)
        masses = each(mass, shape, "mass")
        for body, kilograms in zip(named, typing.cast(Floats, masses)):
            self._native.set_mass(int(body), float(kilograms))

    def move(self, ids: Any, position: Any, orientation: Optional[Any] = None, steps: int = 1) -> None:
        """Moves kinematic bodies to poses, (n, 3) and (n, 4), within that many steps, pushing what they meet; then they stand."""
        named = ids_of(ids, len(self))
        turn = self.orientation[named] if orientation is None else vectors(orientation, len(named), 4, "orientation")
        self._native.move(named, vectors(position, len(named), 3, "position"), np.ascontiguousarray(turn), count_of(steps, "steps"))

    def set_fields(self, **fields: Any) -> None:
        """Wind, water and attractors from the next step on, in place of those before; see Scene.set_fields."""
        require_keys(fields, _native.keys("fields"), "fields")
        self._native.set_fields(json_text(fields, "/fields"))

    def set_filter(self, ids: Any, filter: Filter) -> None:
        """Changes which bodies collide, from the next step on; wakes all."""
        for body in self._flat(ids)[0]:
            self._native.set_filter(int(body), json_text(filter, "/filter"))

    def set_motion(self, ids: Any, motion: str) -> None:
        """Makes bodies "dynamic", "fixed" or "kinematic" from the next step on."""
        for body in self._flat(ids)[0]:
            self._native.set_motion(int(body), str(motion))

    def exclude(self, a: int, b: int, excluded: bool = True) -> None:
        """Whether two bodies never collide with each other."""
        self._native.set_exclusion(index(a, "body"), index(b, "body"), bool(excluded))

    # ---- settings that may change
    @property
    def gravity(self) -> Tuple[float, float, float]:
        """(3,), m/s^2; settable, from the next step on."""
        x, y, z = self._native.gravity
        return (x, y, z)

    @gravity.setter
    def gravity(self, value: Vector) -> None:
        self._native.gravity = triple(value, "gravity")

    @property
    def cell_size(self) -> Tuple[float, ...]:
        """(3,), m: of the periodic cell now; 0 along axes without."""
        return self._native.cell()[0]

    @property
    def cell_rate(self) -> Tuple[float, ...]:
        """(3,), 1/s: at which the periodic cell stretches; settable, from the next step on."""
        return self._native.cell()[1]

    @cell_rate.setter
    def cell_rate(self, value: Vector) -> None:
        self._native.tune("cell_rate", [float(x) for x in triple(value, "cell_rate")])

    def tune(self, *, substeps: Optional[int] = None, friction_factor: Optional[float] = None,
             least_restitution: Optional[float] = None, sleeping: Optional[bool] = None) -> None:
        """Changes settings from the next step on."""
        for name, value in (("substeps", substeps), ("friction_factor", friction_factor),
                            ("least_restitution", least_restitution), ("sleeping", sleeping)):
            if value is not None:
                self._native.tune(name, whole(value, name) if name == "substeps" else number(value, name))

    # ---- contacts and events
    def contacts(self) -> "np.recarray[Any, Any]":
        """All contacts of the last step, touching or speculative, ordered by bodies and parts.

        Fields, also attributes: a, b (ids), part_a, part_b, normal (3,) from a to b, friction (3,) on b, N, count (points), and
        of each of 4 points position (3,), m, separation, m, below 0: they overlap, and force, N, along the normal.
        """
        return self._native.contacts().view(np.recarray)

    def touch_force(self, ids: Any) -> Floats:
        """(n, 3), N: sums of the contact forces on bodies in the last substep; 0 without contacts. ids of (copies, k): (copies, k, 3)."""
        named, shape = self._flat(ids)
        return self._native.touch_forces(named).reshape(*shape, 3)

    def set_measures(self, *, regions: Any = (), gates: Any = (), bodies: Any = (), grid: Optional[typing.Mapping[str, Any]] = None,
                     copy: int = 0) -> None:
        """What measures() tells from now on, in the words of scene files ("measures").

        regions: {"name": "core", "shape": {"box": {"lower": (x, y, z), "upper": (x, y, z)}}}, or a "cylinder" with "from", "to" and
        "radius", or a "sphere" with "centre" and "radius". gates: {"name": "outlet", "centre": .., "u": .., "v": ..}, half edges
        of a rectangle; flow along u x v is positive. bodies: ids, names, or {"body": id, "about": point of the torque}. grid:
        {"lower": .., "upper": .., "cell": (dx, dy, dz)}. copy: whose grains count. Raises SceneError with the place of an error.
        """
        given = bodies.tolist() if isinstance(bodies, np.ndarray) else list(bodies)
        loads = [one if isinstance(one, dict) else {"body": one} for one in given]
        request: Dict[str, Any] = {"regions": list(regions), "gates": list(gates), "bodies": loads}
        if grid is not None:
            request["grid"] = grid
        self._native.set_measures(json_text(request, "measures"), index(copy, "copy"))

    def measures(self) -> Measures:
        """Measures of the grains, all solid dynamic bodies, as they are now: see Measures. What set_measures() said, else the scene."""
        return Measures(*self._native.measure())

    def set_events(self, *, contacts: bool = True, hit_speed: Optional[float] = None, breaks: bool = True, sleep: bool = False,
                   sensors: bool = True) -> None:
        """Which events are recorded from the next step on. hit_speed: m/s, least approach speed of a hit; None: no hits."""
        self._told_of_events = True
        self._native.set_events(bool(contacts), 1e30 if hit_speed is None else number(hit_speed, "hit_speed"), bool(breaks), bool(sleep),
                                bool(sensors))

    def events(self) -> "np.recarray[Any, Any]":
        """What happened since the last call, ordered by step, kind, bodies and parts; none is lost, every begin has one end.

        Fields, also attributes: step, kind (EventKind), a, b (ids; -1: the world), a_generation, b_generation, part_a, part_b,
        joint, speed (m/s, of a hit), impulse (N s), point (3,), m, and normal (3,) from a to b, of a begin or hit.
        Nothing is recorded before World(events=...), set_events() or the first call, which warns.
        """
        if not self._told_of_events and not self._native.records_events():
            import warnings

            self.set_events()
            warnings.warn("events are recorded from now on; say World(scene, events=True) to have them from the start",
                          RuntimeWarning, stacklevel=2)
        return self._native.take_events().view(np.recarray)

    def sensed(self) -> "np.recarray[Any, Any]":
        """What overlaps sensors (bodies with role="sensor") now: sensor, sensor_part, body, part, in order."""
        return self._native.sensed().view(np.recarray)

    # ---- queries
    def cast_rays(self, origins: Any, directions: Any, reach: Any = np.inf, *, mask: int = ALL_CATEGORIES, solid: bool = True,
                  copy: Any = 0) -> "np.recarray[Any, Any]":
        """The nearest hit of each ray. origins, directions: (n, 3) or one row for all; reach: m, one or (n,); np.inf: no limit.

        Fields, also attributes: body (-1: nothing), part, distance (m, infinite where there is nothing), point (3,), normal (3,).
        mask: of the categories seen; solid: a ray that begins in a body hits it at 0, else it leaves it unseen. copy: of the
        scene, one or (n,), in a world of several; likewise below.
        (height, width, 3) give (height, width) hits.
        """
        rays, shape = self._rays(origins, directions, reach)
        return self._native.cast_rays(*rays, _mask(mask), solid, ids_of(np.asarray(copy).reshape(-1), self.copies, "copies")).reshape(shape).view(np.recarray)

    def rays_hit(self, origins: Any, directions: Any, reach: Any = np.inf, *, mask: int = ALL_CATEGORIES, solid: bool = True,
                 copy: Any = 0) -> npt.NDArray[np.bool_]:
        """(n,): whether each ray hits anything; otherwise as cast_rays, and faster."""
        rays, shape = self._rays(origins, directions, reach)
        return self._native.rays_hit(*rays, _mask(mask), solid, ids_of(np.asarray(copy).reshape(-1), self.copies, "copies")).reshape(shape)

    def cast_rays_through(self, origins: Any, directions: Any, reach: Any = np.inf, *, mask: int = ALL_CATEGORIES,
                          solid: bool = True, copy: Any = 0) -> Tuple[Ids, "np.recarray[Any, Any]"]:
        """The first hit of each body and part, near ones first: (starts, hits), of ray i hits[starts[i]:starts[i + 1]]."""
        rays, _ = self._rays(origins, directions, reach)
        starts, hits = self._native.cast_rays_through(*rays, _mask(mask), solid, ids_of(np.asarray(copy).reshape(-1), self.copies, "copies"))
        return starts, hits.view(np.recarray)

    @staticmethod
    def _rays(origins: Any, directions: Any, reach: Any) -> Tuple[Tuple[Floats, Floats, Floats], Tuple[int, ...]]:
        start, along = floats(origins, "origins"), floats(directions, "directions")
        for name, array in (("origins", start), ("directions", along)):
            if array.ndim == 0 or array.shape[-1] != 3:
                raise ValueError(f"{name}: have the shape {array.shape}, should have (n, 3)")
        try:
            shape = np.broadcast_shapes(start.shape, along.shape)[:-1] or (1,)
        except ValueError:
            raise ValueError(f"origins and directions: have the shapes {start.shape} and {along.shape}") from None
        n = int(np.prod(shape))
        flat = [np.ascontiguousarray(np.broadcast_to(one, (*shape, 3))).reshape(n, 3) for one in (start, along)]
        return (flat[0], unit(flat[1], "directions"), typing.cast(Floats, each(reach, shape, "reach"))), shape

    def cast_shapes(self, shape: Shape, origins: Any, directions: Any, reach: Any = 1.0, *, orientation: Any = (0.0, 0.0, 0.0, 1.0),
                    mask: int = ALL_CATEGORIES, copy: Any = 0, solid: bool = True, ignore: Any = None) -> "np.recarray[Any, Any]":
        """The first body that a shape meets as it moves along each line; fields as of cast_rays, point: where the origin of the shape is then.

        shape: convex (a Hull, too) or a Compound of solid convex parts; origins: of its centre, of a Hull or Compound of the origin of
        its points or parts. reach: m, also np.inf, one or (n,); orientation: (4,) or (n, 4).
        solid: a body that the shape overlaps at the start is hit at distance 0; False: only if the shape moves deeper in, so a character
        that stands or touches a wall moves along and away. ignore: a body that is passed through, one id, or (n,), -1 for none.
        """
        (start, along, far), _ = self._rays(origins, directions, reach)
        turns = vectors(orientation, len(start), 4, "orientation")
        return self._native.cast_shapes(json_text(shape, "/shape"), start, along, turns, far, _mask(mask),
                                        ids_of(copy, self.copies, "copies"), bool(solid), self._ignored(ignore)).view(np.recarray)

    def closest_points(self, points: Any, reach: Any = 1.0, *, mask: int = ALL_CATEGORIES, copy: Any = 0) -> "np.recarray[Any, Any]":
        """The nearest point of any body within reach (m, also np.inf) of each point, (n, 3); fields as of cast_rays, distance 0 in a body."""
        place = np.atleast_2d(floats(points, "points"))
        place = vectors(place, len(place), 3, "points")
        return self._native.closest_points(place, vectors(reach, len(place), 0, "reach"), _mask(mask), ids_of(copy, self.copies, "copies")).view(np.recarray)

    def overlaps(self, shape: Shape, positions: Any, *, orientation: Any = (0.0, 0.0, 0.0, 1.0),
                 mask: int = ALL_CATEGORIES, copy: Any = 0, ignore: Any = None) -> Tuple[Ids, "np.recarray[Any, Any]"]:
        """All bodies and parts that a shape as of cast_shapes overlaps at each position: (starts, parts), as of cast_rays_through."""
        starts, parts = self._native.overlaps(*self._overlaps(shape, positions, orientation, mask, copy, ignore))
        return starts, parts.view(np.recarray)

    def penetrations(self, shape: Shape, positions: Any, *, orientation: Any = (0.0, 0.0, 0.0, 1.0),
                     mask: int = ALL_CATEGORIES, copy: Any = 0, ignore: Any = None) -> Tuple[Ids, "np.recarray[Any, Any]"]:
        """The same with depths: (starts, depths), whose fields are body, part, depth, m, and normal (3,), from the body.

        Moved by the depth along the normal the shape only touches, and may be told again with a depth of rounding, some 1e-7 of its
        coordinates: compare depths with what you tolerate. Of a Compound its deepest part.
        """
        starts, depths = self._native.penetrations(*self._overlaps(shape, positions, orientation, mask, copy, ignore))
        return starts, depths.view(np.recarray)

    def _ignored(self, ignore: Any) -> Ids:
        return np.full(1, -1, dtype=np.int64) if ignore is None else ids_of(ignore, len(self), "ignore")

    def _overlaps(self, shape: Shape, positions: Any, orientation: Any, mask: int, copy: Any,
                  ignore: Any) -> Tuple[str, Floats, Floats, int, Ids, Ids]:
        place = np.atleast_2d(floats(positions, "positions"))
        place = vectors(place, len(place), 3, "positions")
        turns = vectors(orientation, len(place), 4, "orientation")
        return json_text(shape, "/shape"), place, turns, _mask(mask), ids_of(copy, self.copies, "copies"), self._ignored(ignore)

    def debug_drawing(self, ids: Any = None, *, shapes: bool = True, contacts: bool = True, joints: bool = True, boxes: bool = False,
                      segments: int = 24, line_length: float = 0.2, force_length: float = 1e-4) -> "DebugDrawing":
        """Lines and points to draw: edges of shapes, contacts with normals and forces, joints with anchors and axes, boxes about bodies.

        ids: of these bodies alone. segments: of a circle, 3 to 360; line_length: of normals and axes, m; force_length: m per N.
        """
        named = None if ids is None else ids_of(ids, len(self), "ids")
        return DebugDrawing(*self._native.debug_drawing(named, bool(shapes), bool(contacts), bool(joints), bool(boxes),
                                                        count_of(segments, "segments"), number(line_length, "line_length"),
                                                        number(force_length, "force_length")))

    # ---- files
    def export(self, path: Union[str, "os.PathLike[str]"], every: int = 1, clips: int = 0) -> "Export":
        """Writes an animation, .glb (glTF 2.0) for Blender and web viewers, or .usda (USD, a point instancer) for Houdini, Maya and
        Omniverse: the bodies as they are, and how they move from now on.

        The file is there at once; steps to come are recorded, one in `every`, and written by close() of what is returned, at the
        end of a with statement, or with the world's end. Bodies are those of now, coloured by their greatest momentum; fragments
        appear as bodies break. clips: moments in each value clip of a .usda, files of their own in the folder PATH.clips; 0: all in one file.
        Or .json: the scene as it is now. Raises OSError, and ValueError for more than 10,000 moving bodies in a .glb.
        """
        name = os.fspath(path)
        if name.endswith(".json"):
            self.snapshot().save(name)
            return Export(None)
        if not name.endswith((".glb", ".usda")):
            raise ValueError(f"export: {name}: is neither a .glb, a .usda nor a .json")
        return Export(self._native.export_to(name, count_of(every, "every"), count_of(clips, "clips")))

    # ---- saving
    def save(self) -> bytes:
        """The whole state: contacts with their impulses, sleep, joints, breaks, edits, settings."""
        return self._native.save()

    def restore(self, mark: Union[bytes, bytearray, memoryview]) -> None:
        """Returns to a saved state, the bytes of save(), of a world of the same scene, on any backend: later steps give the same bits.

        Raises CheckpointError, changing nothing, and BufferError while views (World.tables) live.
        """
        if not isinstance(mark, (bytes, bytearray, memoryview)):
            raise TypeError(f"restore: takes the bytes of save(), not {type(mark).__name__}")
        self._native.restore(bytes(mark))

    def keep_state(self) -> None:
        """Keeps the present state where the runner has it, on a device in its memory; of ten the oldest goes."""
        self._native.keep_state()

    def roll_back(self, steps: int) -> None:
        """Goes back to the state kept `steps` steps ago: later steps give the same bits. Later kept states are dropped.

        Raises IndexError, naming the steps that are kept, if there is none, and BufferError while views (World.tables) live.
        """
        self._native.roll_back(count_of(steps, "steps"))

    @property
    def kept_states(self) -> typing.List[int]:
        """Numbers of steps done at which states are kept, ascending."""
        return self._native.kept_states()

    def drop_states(self) -> None:
        """Drops all kept states, and frees their memory."""
        self._native.drop_states()

    def write_checkpoint(self, path: Union[str, "os.PathLike[str]"], note: str = "") -> None:
        """Writes save() and a note to a file, atomically, for read_checkpoint. Raises OSError."""
        self._native.write_checkpoint(os.fspath(path), str(note))

    def read_checkpoint(self, path: Union[str, "os.PathLike[str]"]) -> str:
        """Restores what write_checkpoint or scree run --checkpoint wrote, and returns the note. Raises as restore, and OSError."""
        return self._native.read_checkpoint(os.fspath(path))

    def snapshot(self, copy: Optional[int] = None) -> Scene:
        """The present scene: existing bodies with their poses and velocities; contacts begin anew in a world made of it.

        copy: which, in a world of several.
        """
        return Scene._of(self._native.snapshot(None if copy is None else index(copy, "copy")))

    # ---- joints and vehicles
    # Joints are named by index, by name, by an array of either, (k,), by a mask, or by (copies, k) of joint_ids(). Names stand for
    # the joints of all copies. `axis`: of "x", "y", "z", "twist", "swing_y", "swing_z"; without one that along or about which each
    # moves: x of a slider or distance, else twist.
    def joints(self) -> "np.recarray[Any, Any]":
        """All joints, (m,), or (copies, m): force (3,), N, and torque (3,), N m, on b, max_force, max_torque, broken, gap (m), coordinates (6,),
        rates (6,).

        Coordinates: x, y, z (m), twist, swing_y, swing_z (rad); the angle of a hinge, a twist or a swing alone counts turns.
        Rates: theirs, m/s and rad/s.
        """
        return self._shaped(self._native.joints()).view(np.recarray)

    @property
    def joint_positions(self) -> Floats:
        """(m,), or (copies, m): where each joint is: the angle of a hinge, rad, with whole turns; of a slider how far, m.

        Of others the length of a distance joint, m, and the twist, rad. set_joint_coordinates() changes them; other axes: joints().
        """
        return self._shaped(self._native.joint_motions()[0])

    @property
    def joint_rates(self) -> Floats:
        """(m,), or (copies, m): how fast joint_positions change, rad/s and m/s."""
        return self._shaped(self._native.joint_motions()[1])

    def joint(self, name: str) -> int:
        """The index of the joint of that name in the scene, and so in copy 0; raises KeyError. Of all copies: joint_ids(name).

        Where a joint is asked for, its name means that of every copy.
        """
        if not isinstance(name, str):
            raise TypeError(f"joint: takes one name, not {type(name).__name__}; of several: joint_ids")
        return index_by_name(self._native, "world", "joints", name)

    @property
    def joint_names(self) -> typing.List[str]:
        """The names of the joints of the scene, by index; "" without one."""
        return self._native.names("joints")

    def joint_ids(self, joints: Any = None, copies: Any = None) -> Ids:
        """(copies, k): the indices, in this world, of joints of the scene (indices or names) in copies; without arguments of all."""
        every = self._native.joint_count() // self.copies
        if _are_names(joints):
            joints = [self.joint(one) if isinstance(one, str) else one for one in ([joints] if isinstance(joints, str) else joints)]
        joint = np.arange(every) if joints is None else ids_of(joints, every, "joints")
        copy = np.arange(self.copies) if copies is None else ids_of(copies, self.copies, "copies")
        for what, given, most in (("joint", joint, every), ("copy", copy, self.copies)):
            if given.size and (given.min() < 0 or given.max() >= most):
                raise IndexError(f"{what} {given.max() if given.max() >= most else given.min()} of {most}")
        made: Ids = copy[:, None].astype(np.int64) * every + joint[None, :]
        return made

    def _joints_of(self, joints: Any) -> Tuple[Ids, Tuple[int, ...]]:
        """Indices one after the other, and their shape."""
        if _are_names(joints):
            named = self.joint_ids(joints)
            if self._copies is None:
                named = named[0, 0] if isinstance(joints, str) else named[0]
            return named.reshape(-1), named.shape
        array = np.asarray(joints)
        count = self._native.joint_count()
        if array.dtype == np.bool_:
            if array.shape not in ((count,), (self.copies, count // self.copies)):
                raise IndexError(f"joints: a mask of the shape {array.shape} for {count} joints")
            array = np.flatnonzero(array)
        flat = ids_of(array.reshape(-1), count, "joints")
        return flat, array.shape

    @staticmethod
    def _axis_name(axis: Optional[str]) -> str:
        if axis is not None and axis not in _AXES:
            raise ValueError(f"axis: unknown {axis!r}; known: {', '.join(_AXES)}")
        return axis or ""

    def add_joint(self, kind: JointKind, a: Optional[int] = None, b: Optional[int] = None, *, anchor: Optional[Vector] = None,
                  axis: Vector = (1.0, 0.0, 0.0), **fields: Any) -> int:
        """Joins two bodies (None: the world) where they are now, and returns the joint's index. As Scene.add_joint."""
        require_keys(fields, _native.keys("joint"), "a joint")
        joint: Dict[str, Any] = {"kind": kind, **fields}
        joint.update({key: index(body, key) for key, body in (("a", a), ("b", b)) if body is not None})
        return self._native.add_joint(json_text(joint, "/joint"), None if anchor is None else triple(anchor, "anchor"), triple(axis, "axis"))

    def remove_joint(self, joint: int) -> None:
        """Removes a joint; higher indices decrease by one."""
        self._native.remove_joint(index(joint, "joint"))

    def set_motor(self, joints: Any, speed: Any, max_force: Any, axis: Optional[str] = None) -> None:
        """Drives joints at a speed: m/s and N along x, y, z, rad/s and N m about the others; one number for all, or one each.

        A spring of the axis stays, and a motor without force beside one is none; the motor takes the place of friction. Raises SceneError
        beside a spring that acts with max_force or a speed.
        """
        named, shape = self._joints_of(joints)
        self._native.set_motors(named, self._axis_name(axis), typing.cast(Floats, each(speed, shape, "speed")),
                                typing.cast(Floats, each(max_force, shape, "max_force")))

    def set_spring(self, joints: Any, spring: Spring, axis: Optional[str] = None) -> None:
        """Puts a spring on joints, in place of that which they have; a motor or friction stays."""
        named, _ = self._joints_of(joints)
        self._native.set_springs(named, self._axis_name(axis), json_text(spring, "/spring"))

    def set_drive(self, joints: Any, *, stiffness: Optional[Any] = None, damping: Optional[Any] = None, target: Optional[Any] = None,
                  target_speed: Optional[Any] = None, max_force: Optional[Any] = None, axis: Optional[str] = None) -> None:
        """Servos, of many joints at once: stiffness (target - coordinate) + damping (target_speed - rate), at most max_force.

        Each a number for all, or an array of the shape of the joints; what is not given stays. It is the axis's spring, and takes the place
        of a motor, and with max_force or target_speed that of friction. max_force of robot files: their effort. Units: m and N, or rad and N m.
        """
        require_some("set_drive", stiffness=stiffness, damping=damping, target=target, target_speed=target_speed, max_force=max_force)
        named, shape = self._joints_of(joints)
        self._native.set_drives(named, self._axis_name(axis), each(stiffness, shape, "stiffness"), each(damping, shape, "damping"),
                                each(target, shape, "target"), each(target_speed, shape, "target_speed"),
                                each(max_force, shape, "max_force"))

    def drives(self, axis: Optional[str] = None) -> "np.recarray[Any, Any]":
        """What drives and limits an axis of each joint now, (m,), or (copies, m).

        Fields, also attributes: of the spring stiffness, damping, target, target_speed, max_force; of the motor motor_speed, motor_force;
        friction, armature, lower, upper (limits), locked. 0, or infinite, where there is none.
        """
        name = self._axis_name(axis)
        return self._shaped(self._native.drives(_AXES.index(name) if name else -1)).view(np.recarray)

    def set_joint_coordinates(self, joints: Any, coordinate: Optional[Any] = None, rate: Optional[Any] = None, *,
                              axis: Optional[str] = None) -> None:
        """Places bodies so that joints have these coordinates (m or rad) and rates (m/s or rad/s); what is not given stays.

        A number for all, or an array of the shape of the joints. What hangs on a joint moves along, seen from the root of its tree,
        which stays: the world, what is not dynamic, else the one body that is b of no joint. Raises ValueError for joints in a loop, and
        for what is out of a joint's limits, and then changes nothing.
        """
        require_some("set_joint_coordinates", coordinate=coordinate, rate=rate)
        named, shape = self._joints_of(joints)
        self._native.set_joint_coordinates(named, self._axis_name(axis), each(coordinate, shape, "coordinate"),
                                           each(rate, shape, "rate"))

    def apply_joint_forces(self, joints: Any, force: Any, axis: Optional[str] = None) -> None:
        """Forces (N) or torques (N m) of joints on b, the opposite on a, in the next step: a number for all, or one each. They add up.

        joints: indices or names, (k,) or (copies, k); force broadcasts to their shape.
        """
        named, shape = self._joints_of(joints)
        self._native.apply_joint_forces(named, self._axis_name(axis), typing.cast(Floats, each(force, shape, "force")))

    def vehicles(self) -> "np.recarray[Any, Any]":
        """All vehicles: throttle, brake, steer, hand_brake, speed (m/s), curvature (1/m), by_route, passed, next, arrived."""
        return _fixed(self._native.vehicles()).view(np.recarray)

    def drive(self, vehicle: int, throttle: float = 0.0, brake: float = 0.0, steer: float = 0.0, hand_brake: float = 0.0) -> None:
        """Sets a vehicle's controls until the next call: throttle and steer -1 to 1 (1: left), brakes 0 to 1."""
        self._native.drive(index(vehicle, "vehicle"), number(throttle, "throttle"), number(brake, "brake"), number(steer, "steer"),
                           number(hand_brake, "hand_brake"))

    def drive_by_route(self, vehicle: int) -> None:
        """The vehicle follows its route again."""
        self._native.drive_by_route(index(vehicle, "vehicle"))

    def reset_upright(self, vehicle: int) -> None:
        """Puts a vehicle upright, at rest, half a metre above where it is."""
        self._native.reset_upright(index(vehicle, "vehicle"))

    # ---- hands
    def grip(self, body: int, anchor: Vector, target: Vector, *, hertz: float = 5.0, damping_ratio: float = 1.0,
             max_acceleration: float = 300.0, spin_damping: float = 5.0) -> int:
        """Pulls a point of a body (anchor, (3,), in its frame, m) to a target, (3,), m, by a damped spring; returns the grip."""
        return self._native.grip(index(body, "body"), triple(anchor, "anchor"), triple(target, "target"), number(hertz, "hertz"),
                                 number(damping_ratio, "damping_ratio"), number(max_acceleration, "max_acceleration"),
                                 number(spin_damping, "spin_damping"))

    def move_grip(self, grip: int, target: Vector) -> None:
        """Moves a grip's target."""
        self._native.move_grip(index(grip, "grip"), triple(target, "target"))

    def release(self, grip: int) -> None:
        """Lets go."""
        self._native.release(index(grip, "grip"))

    def explode(self, centre: Vector, radius: float, speed: float) -> None:
        """Adds a velocity away from centre, (3,), m: `speed`, m/s, there, falling to 0 at `radius`, m."""
        self._native.explode(triple(centre, "centre"), number(radius, "radius"), number(speed, "speed"))

    # ---- pictures
    @property
    def camera(self) -> Camera:
        """The scene's camera, or one that sees its bodies at the start."""
        eye, target, fov, orthographic = self._native.suggested_camera()
        return Camera(eye, target, fov, orthographic)

    def render(self, camera: Optional[Camera] = None, size: Size = (640, 480), channels: Union[str, typing.Sequence[str]] = ("color",), *,
               color: Optional[str] = None, camera_before: Optional[Camera] = None, seconds_before: Optional[float] = None,
               copy: Optional[int] = None, **look: Any) -> Picture:
        """A picture, with its channels as arrays.

        size: (width, height), pixels. channels of color, depth, body, part, normal, flow: see Picture. All but color are cast
        as rays at the pixels' centres: exact, and the same bits on every backend. color is drawn by a Vulkan device or with
        OpenGL ES, with smooth edges; DeviceError names what is missing.
        color: the quantity shown: momentum, speed, spin, kinetic-energy, height, body, plain, angular-momentum,
        contact-impulse, contacts, sleep, material; default: the scene's, mostly momentum. Also color_map, color_scale,
        color_range (low, high), show (contacts, velocities, joints, boxes, cells, sleep), sky (day, evening, overcast, studio,
        night), sun_azimuth and sun_elevation (degrees), caption, legend, shadows,
        samples (1, 4, 9 or 16), canvas (auto, vulkan, gl).
        copy: of the scene, in a world of several; by default the first.
        flow: motion of what is seen since `seconds_before` (default: a step ago), when the camera was camera_before.
        """
        require_keys(look, _LOOK, "render")
        wanted = [channels] if isinstance(channels, str) else list(channels)
        for name in wanted:
            if name not in CHANNELS:
                raise ValueError(f'channels: unknown "{name}"; known: {", ".join(CHANNELS)}')
        if color is not None:
            look["color"] = color
        width, height = (count_of(side, "size") for side in size)
        seen = self.camera if camera is None else camera
        seconds = 1 / self.settings["rate"] if seconds_before is None else seconds_before
        arrays = self._native.render(seen._text(), width, height, wanted, json_text(look, "/picture"),
                                     "" if camera_before is None else camera_before._text(), seconds,
                                     0 if copy is None and self._copies is not None else copy)
        return Picture({name: arrays[name] for name in wanted})

    # ---- recordings that play in a browser
    def record(self, *, fps: float = 30.0, title: str = "", camera: Optional[Camera] = None, color: Optional[str] = None, copy: Optional[int] = None,
               contacts: Optional[bool] = None, events: bool = False, **look: Any) -> Recording:
        """Records the steps from now on as a page that plays them in any browser: save() writes it, view() shows it in a notebook.

            with world.record() as recording:
                world.step(300)
            recording.save("run.html")

        It is kept in memory: 1.6 MB for a minute of a thousand bodies that come to rest. fps: frames a second of time, in whole steps.
        color and look (color_map, color_scale, color_range, show, sky, sun_azimuth, sun_elevation): how the page begins, as of render().
        copy: of the scene, in a world of several; by default all, side by side. contacts: whether the points that touch are recorded,
        None: of at most 2,000 bodies. events: hits and breaks, on the page's time line; they are then lost to events().
        Raises RuntimeError where the library has no viewer.
        """
        require_keys(look, _LOOK[:-5], "record")
        if color is not None:
            look["color"] = color
        return Recording(self, self._native.record(str(title), "" if camera is None else camera._text(), json_text(look, "/picture"),
                                                   number(fps, "fps"), None if copy is None else index(copy, "copy"),
                                                   None if contacts is None else bool(contacts), bool(events)))

    def view(self, height: int = 480, **options: Any) -> View:
        """In a notebook: the viewer with the world as it is now; the steps that follow appear in it when their cell is done.

        options: as of record(). view.close() ends it; view.recording.save() writes the page.
        """
        return self.record(**options).view(height)

    # ---- costs
    def stage_times(self) -> Dict[str, float]:
        """Milliseconds per step of each stage: means over the timed steps. On a device after set_profiling(True)."""
        return self._native.stage_times()

    def set_profiling(self, on: bool) -> None:
        """Whether later steps are timed stage by stage."""
        self._native.set_profiling(on)

    @property
    def buffer_bytes(self) -> int:
        """Bytes of all tables of a step."""
        return self._native.buffer_bytes

    def __repr__(self) -> str:
        return f"<scree.World of {len(self)} bodies after {self.steps} steps, on {self.device}>"
