# Scenes: what is to be simulated.
"""Scenes: bodies, joints and vehicles as plain data in SI units, y up."""
from __future__ import annotations

import difflib
import json
import os
import typing
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy as np

from scree import _native
from scree._arrays import Bodies, Ids, count_of, floats, index_by_name, json_text, number, require_keys, triple, vectors, whole
from scree._errors import SceneError
from scree.camera import Camera
from scree.joints import JointKind
from scree.shapes import HeightField, Mesh, Plane, Shape, Vector

_VECTORS = {"position": 3, "orientation": 4, "velocity": 3, "angular_velocity": 3, "surface_velocity": 3}
_NUMBERS = frozenset({"density", "friction", "restitution", "rolling_resistance", "linear_damping", "angular_damping", "gravity_scale",
                      "static_friction", "spinning_resistance", "restitution_threshold", "cohesion", "cohesion_range", "drag"})


def _count_of(columns: typing.Mapping[str, Any]) -> Optional[int]:
    """How many bodies the arrays describe; None if each is of one body."""
    counts = {}
    for key, value in columns.items():
        dimensions = 2 if key in _VECTORS else 1
        if np.ndim(value) == dimensions:
            counts[key] = int(np.shape(value)[0])
    if len(set(counts.values())) > 1:
        raise ValueError("arrays of different lengths: " + ", ".join(f"{key} {count}" for key, count in counts.items()))
    return next(iter(counts.values()), None)


def _density_of(shape: Shape, mass: Any) -> Any:
    """The density, or densities, at which a shape has that mass."""
    kilograms = floats(mass, "mass").astype(np.float64)
    body = json_text({"shape": shape, "motion": "fixed"}, "/bodies/0")
    volume, twice = (_native.mass_properties(body, density)[0] for density in (1.0, 2.0))
    if volume <= 0:
        raise ValueError(f"mass: a {type(shape).__name__} has none")
    if abs(twice - 2 * volume) > 1e-5 * twice:
        raise ValueError("mass: parts have densities of their own; leave these out, or give inertial={...}")
    density = kilograms / volume
    wrong = ~((density >= 1e-3) & (density <= 1e6))
    if np.any(wrong):
        raise ValueError(f"mass: {kilograms[wrong].flat[0]:g} kg in {volume:g} m^3 is a density out of 0.001 to 1,000,000 kg/m^3; "
                         "inertial={...} gives any mass, and World.set_mass changes it later")
    return density.astype(np.float32) if density.ndim else float(density)


class Scene(Bodies[_native.Description]):
    """Bodies, joints and vehicles to simulate, in SI units, y up.

    gravity: (3,), m/s^2. `notes` tells what was changed or left out in reading a file.
    """

    def __init__(self, gravity: Vector = (0.0, -9.81, 0.0)) -> None:
        self._native = _native.Description()
        self._notes: List[str] = []
        self.gravity = gravity  # type: ignore[assignment]

    @classmethod
    def _of(cls, native: "_native.Description") -> "Scene":
        made = cls.__new__(cls)
        made._native = native
        made._notes = []
        return made

    # ---- bodies
    def add(self, shape: Shape, position: Optional[Any] = None, *, motion: Optional[str] = None, mass: Optional[Any] = None,
            **fields: Any) -> Any:
        """Adds a body, or many that are alike, in one call.

        position: (3,) or (n, 3), of the centre of mass, m; of hulls, compounds and meshes of the origin of their points.
        orientation: (4,) or (n, 4), x, y, z, w.
        velocity, angular_velocity: (3,) or (n, 3), m/s, rad/s.
        motion: "dynamic", "fixed" or "kinematic"; by default fixed for planes, height fields and meshes without decompose, dynamic for others.
        mass: kg, a number or (n,), in place of density: the scene gets the density that gives it.
        density (kg/m^3), friction, restitution, rolling_resistance (m), linear_damping (1/s), angular_damping (1/s), gravity_scale: numbers or (n,).
        name, filter, tyre, fracture, inertial, role ("sensor", "drawn"): of all, as every other key of a body in a scene file.

        Returns the id of the body; of many their ids, (n,) int64. Ids count bodies from 0 and do not change.
        Raises SceneError, whose `pointer` names the value, here or when a World is made; TypeError for an unknown key.
        """
        require_keys(fields, _native.keys("body"), "a body")
        if not isinstance(shape, Shape):
            raise TypeError(f"shape: is the class {shape.__name__}; make one: scree.{shape.__name__}()" if isinstance(shape, type)
                            else f"shape: is a shape, such as scree.Box(), not {type(shape).__name__}")
        if mass is not None:
            if fields.get("density") is not None or fields.get("inertial") is not None:
                raise ValueError("mass: is given by density or inertial already; leave one out")
            fields["density"] = _density_of(shape, mass)
        inertial = fields.get("inertial")
        if isinstance(inertial, dict) and "mass" in inertial and "inertia" not in inertial:
            where = f"/bodies/{len(self)}/inertial"
            raise SceneError(f'{where}: lacks "inertia", (3,), kg m^2; mass= gives a mass, and the shape the rest', where)
        columns: Dict[str, Any] = {key: fields.pop(key) for key in list(fields) if key in _VECTORS and fields[key] is not None}
        if position is not None:
            columns["position"] = position
        for key in list(fields):
            if key in _NUMBERS and np.ndim(fields[key]) > 0:
                columns[key] = fields.pop(key)
        count = _count_of(columns)
        bodies = count if count is not None else 1
        arrays = {key: vectors(value, bodies, _VECTORS.get(key, 0), key) for key, value in columns.items()}
        if motion is None:
            surface = isinstance(shape, (Plane, HeightField)) or (isinstance(shape, Mesh) and shape.decompose is None)
            motion = "fixed" if surface else "dynamic"
        body = {"shape": shape, "motion": motion, **{key: value for key, value in fields.items() if value is not None}}
        first = self._native.add_bodies(json_text(body, f"/bodies/{len(self)}"), bodies, arrays)
        return first if count is None else np.arange(first, first + bodies, dtype=np.int64)

    def __len__(self) -> int:
        """The number of bodies."""
        return self._native.count("bodies")

    @property
    def names(self) -> List[str]:
        """The names of the bodies, by id; "" without one."""
        return self._native.names("bodies")

    def _named(self, things: str, name: Any) -> int:
        one = {"bodies": "body", "joints": "joint", "vehicles": "vehicle"}
        if not isinstance(name, str):
            return whole(name, one[things])
        return index_by_name(self._native, "scene", things, name)

    # ---- joints
    def add_joint(self, kind: JointKind, a: Union[int, str, None] = None, b: Union[int, str, None] = None, *,
                  anchor: Optional[Vector] = None, axis: Optional[Vector] = None, anchor_a: Optional[Vector] = None,
                  anchor_b: Optional[Vector] = None, **fields: Any) -> int:
        """Joins bodies a and b (ids or names; None: the world) and returns the joint's index.

        anchor, axis: (3,), in the world at the start, m; the axis is that of a hinge or slider, or the middle of a cone.
        Or anchor_a, anchor_b: (3,), in the bodies' frames from their centres of mass, m, as for a Distance.
        name, collide, break_force (N), break_torque (N m) and every other key of a joint in a scene file.
        """
        require_keys(fields, _native.keys("joint"), "a joint")
        joint: Dict[str, Any] = {"kind": kind, **fields}
        for key, body in (("a", a), ("b", b)):
            if body is not None:
                joint[key] = self._named("bodies", body)
        for key, value in (("anchor", anchor), ("axis", axis), ("anchor_a", anchor_a), ("anchor_b", anchor_b)):
            if value is not None:
                joint[key] = triple(value, key)
        return self._native.add_joint(json_text(joint, f"/joints/{self._native.count('joints')}"))

    def joint(self, name: str) -> int:
        """The index of the joint of that name; raises KeyError for none, and for several."""
        return self._named("joints", name)

    @property
    def joint_names(self) -> List[str]:
        """The names of the joints, by index; "" without one."""
        return self._native.names("joints")

    def exclude(self, a: Union[int, str], b: Union[int, str]) -> None:
        """Bodies a and b never collide with each other."""
        self._native.add_exclusion(self[a], self[b])

    # ---- vehicles
    def add_car(self, position: Vector = (0.0, 0.0, 0.0), heading: float = 0.0, **fields: Any) -> int:
        """Adds a car of about 1,250 kg and returns the vehicle's index (World.drive).

        position: (3,), on the ground between its wheels, m; heading: rad, about y, 0 along z.
        name, speed (m/s), size, density, friction, brake, hertz, damping_ratio: see Car in compute/vehicle_presets.h.
        """
        return self._native.add_car(json_text({"position": triple(position, "position"), "heading": number(heading, "heading"), **fields}, "/cars"))

    def add_cart(self, position: Vector = (0.0, 0.0, 0.0), heading: float = 0.0, **fields: Any) -> int:
        """Adds a cart that steers like a tank, and returns the vehicle's index. As add_car; name, friction, brake."""
        return self._native.add_cart(json_text({"position": triple(position, "position"), "heading": number(heading, "heading"), **fields}, "/carts"))

    def add_vehicle(self, **fields: Any) -> int:
        """Makes a vehicle of bodies and joints: chassis, wheels, engine, steering, route, loops, as in a scene file."""
        require_keys(fields, _native.keys("vehicle"), "a vehicle")
        return self._native.add_vehicle(json_text(fields, "/vehicles"))

    def vehicle_bodies(self, vehicle: Union[int, str]) -> Ids:
        """The ids of a vehicle's chassis and of its wheels."""
        found = self._named("vehicles", vehicle)
        if not 0 <= found < self._native.count("vehicles"):
            raise IndexError(f"vehicle {found} of {self._native.count('vehicles')}")
        return np.asarray(self._native.vehicle_bodies(found), dtype=np.int64)

    def set_fields(self, **fields: Any) -> None:
        """What acts on all dynamic bodies: wind={"velocity": (3,), m/s}, water={"offset": m}, attractors=[...], as in a scene file."""
        require_keys(fields, _native.keys("fields"), "fields")
        self._native.set_part("fields", json_text(fields, "/fields"))

    def set_periodic(self, size: Vector, *, centre: Vector = (0, 0, 0), rate: Vector = (0, 0, 0)) -> None:
        """A periodic cell: what leaves it through one side comes back through the opposite one.

        size, centre: (3,), m; size 0 along axes without. rate: (3,), 1/s, at which it stretches; see World.cell_rate.
        """
        cell = {"size": triple(size, "size"), "centre": triple(centre, "centre"), "rate": triple(rate, "rate")}
        self._native.set_part("periodic", json_text(cell, "/periodic"))

    # ---- grains
    def add_grains(self, *, sieve: Optional[Any] = None, **keys: Any) -> Ids:
        """Adds grains whose sizes follow a sieve curve, with the keys of "grains" in a scene file.

        sieve: (n, 2), size (m) and % of the mass that passes, ascending from 0 to 100; or size=, m, for one size.
        region: {"box": {"lower": (3,), "upper": (3,)}} or {"cylinder": {"base": (3,), "radius": m, "height": m}}.
        mass (kg), count or fill (part of the region's volume): how many. shapes, density, friction, seed, name and so on.
        mass_rate (kg/s) or count_rate (1/s): they are poured into the region during the run, from start (s) on, with a velocity.

        Returns the ids of grains that are there at the start; none for poured ones. `notes` tells of curves that few grains miss.
        """
        require_keys(keys, _native.keys("grains"), "grains")
        given = {key: value for key, value in keys.items() if value is not None}
        if sieve is not None:
            points = floats(sieve, "sieve")
            if points.ndim != 2 or points.shape[1] != 2:
                raise ValueError(f"sieve: is (n, 2), size and % passing, not {points.shape}")
            given["sieve"] = [{"size": float(size), "passing": float(passing)} for size, passing in points]
        before = len(self)
        self._native.add_grains(json_text(given, "/grains/0"))
        return np.arange(before, len(self), dtype=np.int64)

    # ---- bonds
    def add_bonds(self, **keys: Any) -> None:
        """Bonds bodies that are near each other as they are now, with the keys of "bonds" in a scene file.

        bodies, with: names of bodies or grains; gap, radius: of the smaller radius; tension, shear, stiffness (Pa), damping.
        """
        require_keys(keys, _native.keys("bonds"), "bonds")
        self._native.add_bonds(json_text({key: value for key, value in keys.items() if value is not None}, "/bonds/0"))

    # ---- servo walls
    def add_servo_wall(self, body: Union[int, str], stress: float, axis: Vector = (0.0, -1.0, 0.0), **keys: Any) -> int:
        """Makes a dynamic body a wall that presses along an axis with a stress, Pa, and returns the index of its joint.

        area (m^2), max_speed (m/s), gain (m/(s Pa)), name: as of "servo_walls" in a scene file. World.set_motor of the joint
        with max_force = stress * area asks for another stress.
        """
        require_keys(keys, _native.keys("servo_walls"), "a servo wall")
        given = {"body": self[body], "stress": number(stress, "stress"), "axis": triple(axis, "axis"), **keys}
        return self._native.add_servo_wall(json_text({key: value for key, value in given.items() if value is not None}, "/servo_walls/0"))

    # ---- how it is run and shown
    def at(self, time: float, **action: typing.Mapping[str, Any]) -> None:
        """What happens at a time of a run, s: one of impulse, velocity, glide, explosion, release, motor, gravity, pour,
        shake.

        scene.at(3, impulse={"body": "ball", "impulse": [900, 1500, 0]}), with the keys of scene files.
        """
        if len(action) != 1:
            raise TypeError("at: takes one action, such as impulse={...}")
        self._native.add_event(json_text({"time": time, "action": dict(action)}, "/events"))

    @property
    def gravity(self) -> Tuple[float, float, float]:
        """(3,), m/s^2."""
        x, y, z = self._native.gravity
        return (x, y, z)

    @gravity.setter
    def gravity(self, value: Vector) -> None:
        self._native.gravity = triple(value, "gravity")

    @property
    def settings(self) -> Dict[str, Any]:
        """The settings of a step (rate, substeps, sleeping and so on), as a copy; set it to a dict of those to change."""
        return self._native.settings()

    @settings.setter
    def settings(self, changes: typing.Mapping[str, Any]) -> None:
        require_keys(changes, _native.keys("settings"), "settings")
        self._native.set_part("settings", json_text(dict(changes), "/settings"))

    @property
    def camera(self) -> Optional[Camera]:
        """The camera suggested by the scene, if any."""
        given = self._native.camera()
        if given is None:
            return None
        pose = (given.get("path") or [given])[0]
        return Camera(tuple(pose["eye"]), tuple(pose["target"]), pose.get("vertical_fov", 45.0), given.get("orthographic", False))

    @camera.setter
    def camera(self, value: Union[Camera, typing.Mapping[str, Any], None]) -> None:
        self._native.set_part("camera", "null" if value is None else json_text(value, "/camera"))

    def set_picture(self, **style: Any) -> None:
        """How pictures show the scene: color, color_map, color_scale, color_range, show, sky, sun_azimuth, sun_elevation, as in a scene file."""
        require_keys(style, _native.keys("picture"), "a picture")
        self._native.set_part("picture", json_text(style, "/picture"))

    @property
    def duration(self) -> float:
        """How long a run is by default, s; 0: 10 s."""
        return self._native.duration

    @duration.setter
    def duration(self, seconds: float) -> None:
        self._native.duration = number(seconds, "duration")

    # ---- files
    @property
    def notes(self) -> List[str]:
        """What was changed or left out in reading the scene; may be empty."""
        return [*self._native.notes, *self._notes]

    def check(self) -> List[str]:
        """Checks the scene as World does, and returns remarks on hulls, meshes, and joints that begin apart. Raises SceneError."""
        return self._native.check()

    def to_json(self) -> str:
        """The scene as a scene file's text; floats read back to the same bits."""
        return self._native.to_json()

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes a scene file, for scree run; atomically. Raises OSError."""
        self._native.save(os.fspath(path))

    def copy(self) -> "Scene":
        """A scene of its own."""
        made = Scene._of(_native.Description(self._native))
        made._notes = list(self._notes)
        return made

    def __copy__(self) -> "Scene":
        return self.copy()

    def __deepcopy__(self, _: Any) -> "Scene":
        return self.copy()

    def __reduce__(self) -> Any:
        """Pickles as the scene file's text, with the meshes of files, and the notes."""
        return _unpickled, (self._native.whole_json(), self.notes)

    @property
    def hash(self) -> str:
        """16 hexadecimal digits that name the scene, as "scene_hash" in reports."""
        return self._native.scene_hash()

    def __repr__(self) -> str:
        joints = self._native.count("joints")
        return f"<scree.Scene of {len(self)} bodies, {joints} joints>"


def _unpickled(text: str, notes: List[str]) -> Scene:
    made = from_json(text)
    made._notes = notes
    return made


def load(path: Union[str, "os.PathLike[str]"], *, strict: bool = False, axes: str = "y-up", base: str = "",
         ground: bool = False, keyframe: Union[str, int] = "", packages: Optional[Dict[str, str]] = None,
         allow_outside: bool = False) -> Scene:
    """Reads a scene file and the meshes that it names, or a file of another program: MJCF (.xml, .mjcf), URDF (.urdf, .xml), glTF
    physics (.gltf, .glb), UsdPhysics (.usda, .usdc, .usdz), .stl, .obj. `notes` of the scene tells what of those was not
    translated, with file and line; strict makes that an error.

    axes: "y-up" turns scenes whose z axis points up; "file" keeps their axes, with gravity along -z. base: the root link of a
    URDF, "fixed" or "free"; left out: fixed, with a note. ground: adds a plane that the lowest point touches. keyframe: of an
    MJCF file, by name or index: poses, speeds and controls. packages: folders of package://NAME/..., whose files may be read.
    allow_outside: the file may name meshes and other files outside of its folder.

    Raises OSError, and SceneError with the file and the JSON pointer, or the file and line.
    """
    name = os.fspath(path)
    with open(name, "rb"):  # an OSError with its number, for a file of any kind
        pass
    return Scene._of(_native.load(name, strict, axes, base, ground, str(keyframe), dict(packages or {}), allow_outside))


def from_json(text: str) -> Scene:
    """Reads the text of a scene file. Raises SceneError."""
    if not isinstance(text, str):
        raise TypeError(f"from_json: reads a text, not {type(text).__name__}")
    return Scene._of(_native.from_json(text))


def demo(name: str, bodies: int = 0, seed: int = 1) -> Scene:
    """A demo's scene, as `scree export` writes it; bodies: how many, of demos that take any; 0: the demo's own number.

    Raises KeyError for an unknown name; `demos()` has them all. Scripted actions are left out, which `notes` tells.
    """
    try:
        return Scene._of(_native.demo(str(name), count_of(bodies, "bodies"), count_of(seed, "seed", 2**64 - 1)))
    except KeyError:
        near = difflib.get_close_matches(str(name), list(demos()), 1)
        raise KeyError(f"no demo is named {name!r}" + (f'; nearest: "{near[0]}"' if near else "; demos() has them all")) from None


def demos() -> Dict[str, str]:
    """The names of the demos, with a line about each."""
    return dict(_native.demo_names())


def schema() -> Dict[str, Any]:
    """The JSON Schema of scene files, which says range, unit and meaning of every key."""
    made: Dict[str, Any] = json.loads(_native.schema())
    return made
