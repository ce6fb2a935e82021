# libscree, which the package calls.
"""The library, its functions and its structs, as scree.h has them."""
from __future__ import annotations

import ctypes
import os
import sys
from pathlib import Path
from typing import Any, Iterator, Type

from scree._errors import CheckpointError, DeviceError, SceneError

NAME = {"win32": "scree.dll", "darwin": "libscree.0.dylib"}.get(sys.platform, "libscree.so.0")
_HERE = Path(__file__).absolute().parent


def _places() -> Iterator[str]:
    """Where the library may be: as SCREE_LIBRARY says, in the package, below the prefix that has the package, where the system looks."""
    given = os.environ.get("SCREE_LIBRARY")
    if given:
        yield given
        return
    yield str(_HERE / NAME)
    for folder in list(_HERE.parents)[:4]:
        for place in (folder / NAME, *sorted(folder.glob(f"*-linux-*/{NAME}"))):
            yield str(place)
    yield NAME


def _loaded() -> ctypes.CDLL:
    failures = []
    for place in _places():
        if os.sep in place and not os.path.exists(place):
            continue
        try:
            return ctypes.CDLL(place)
        except OSError as error:
            failures.append(str(error))
    raise ImportError("scree: the library cannot be loaded: " + ("; ".join(failures) or f"{NAME} is not there"))


LIBRARY = _loaded()


class Column(ctypes.Structure):
    _fields_ = [("name", ctypes.c_char_p), ("data", ctypes.c_void_p), ("stride", ctypes.c_size_t)]


class Array(ctypes.Structure):
    _fields_ = [("data", ctypes.c_void_p), ("count", ctypes.c_size_t), ("stride", ctypes.c_size_t)]


class LoadOptions(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("strict", ctypes.c_int), ("file_axes", ctypes.c_int), ("ground", ctypes.c_int),
                ("allow_outside", ctypes.c_int), ("base", ctypes.c_char_p), ("keyframe", ctypes.c_char_p),
                ("packages_json", ctypes.c_char_p)]


class WorldOptions(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("backend", ctypes.c_char_p), ("device", ctypes.c_char_p), ("settings_json", ctypes.c_char_p),
                ("threads", ctypes.c_int), ("validate", ctypes.c_int), ("copies", ctypes.c_size_t)]


class WorldInfo(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("steps", ctypes.c_uint64), ("time", ctypes.c_double), ("bodies", ctypes.c_size_t),
                ("bodies_there", ctypes.c_size_t), ("joints", ctypes.c_size_t), ("copies", ctypes.c_size_t),
                ("buffer_bytes", ctypes.c_size_t), ("buffer_growths", ctypes.c_size_t), ("records_events", ctypes.c_int),
                ("backend", ctypes.c_char_p), ("device", ctypes.c_char_p), ("remark", ctypes.c_char_p)]


class Statistics(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t),
                *((name, ctypes.c_uint64) for name in ("bodies", "broken", "pieces", "manifolds", "points")),
                *((name, ctypes.c_double) for name in ("penetration_mean", "penetration_max", "penetration_resting", "max_speed", "max_spin")),
                ("spin_limited", ctypes.c_uint64), ("kinetic_energy", ctypes.c_double), ("potential_energy", ctypes.c_double),
                ("momentum", ctypes.c_double * 3), ("angular_momentum", ctypes.c_double * 3), ("drift_max", ctypes.c_double),
                *((name, ctypes.c_uint64) for name in ("asleep", "not_finite", "below_ground", "joints", "joints_broken")),
                ("joint_force_max", ctypes.c_double), ("joint_torque_max", ctypes.c_double)]


class EventOptions(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("contacts", ctypes.c_int), ("hit_speed", ctypes.c_float), ("breaks", ctypes.c_int),
                ("sleep", ctypes.c_int), ("sensors", ctypes.c_int)]


class GripOptions(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("hertz", ctypes.c_float), ("damping_ratio", ctypes.c_float),
                ("max_acceleration", ctypes.c_float), ("spin_damping", ctypes.c_float)]


class DebugOptions(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("shapes", ctypes.c_int), ("contacts", ctypes.c_int), ("joints", ctypes.c_int),
                ("boxes", ctypes.c_int), ("segments", ctypes.c_int), ("line_length", ctypes.c_float), ("force_length", ctypes.c_float),
                ("bodies", ctypes.c_void_p), ("body_count", ctypes.c_size_t)]


class PictureOptions(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("width", ctypes.c_int), ("height", ctypes.c_int), ("camera_json", ctypes.c_char_p),
                ("look_json", ctypes.c_char_p), ("camera_before_json", ctypes.c_char_p), ("seconds_before", ctypes.c_double),
                ("copy", ctypes.c_size_t), ("color", ctypes.c_void_p), ("depth", ctypes.c_void_p), ("body", ctypes.c_void_p),
                ("part", ctypes.c_void_p), ("normal", ctypes.c_void_p), ("flow", ctypes.c_void_p)]


class RecordOptions(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("title", ctypes.c_char_p), ("camera_json", ctypes.c_char_p), ("look_json", ctypes.c_char_p),
                ("fps", ctypes.c_double), ("copy", ctypes.c_size_t), ("contacts", ctypes.c_int), ("events", ctypes.c_int), ("live", ctypes.c_int)]


ALL_COPIES = ctypes.c_size_t(-1).value

_KINDS = {"p": ctypes.c_void_p, "s": ctypes.c_char_p, "z": ctypes.c_size_t, "i": ctypes.c_int, "u": ctypes.c_uint64, "f": ctypes.c_float}

# The arguments of each function: p an address or handle, s a text, z a size_t, i an int, u a uint64_t, f a float.
_SIGNATURES = {
    "scree_describe": "ssp", "scree_scene_create": "p", "scree_scene_copy": "pp", "scree_scene_from_json": "sp", "scree_scene_load": "spp",
    "scree_is_import": "sp", "scree_scene_demo": "szup", "scree_scene_add_bodies": "pszpzp", "scree_scene_add": "pssp", "scree_scene_set": "pss",
    "scree_scene_get": "psp", "scree_scene_count": "psp", "scree_scene_find": "pssp", "scree_scene_body_name": "pzp",
    "scree_scene_vehicle_bodies": "pzp", "scree_scene_check": "pp", "scree_scene_hash": "pp", "scree_scene_save": "ps",
    "scree_mass_properties": "sfpp", "scree_world_create": "ppp", "scree_world_create_copies": "pzpp", "scree_world_step": "pupp",
    "scree_world_follow_demo": "pszu",
    "scree_world_get_info": "pp", "scree_world_count": "psp", "scree_world_get": "psp", "scree_world_find": "pssp",
    "scree_world_statistics": "pzp", "scree_world_hash": "pp", "scree_world_copy_hashes": "pp", "scree_world_save": "pp",
    "scree_world_restore": "psz", "scree_world_write_checkpoint": "pss", "scree_world_read_checkpoint": "psp", "scree_world_keep_state": "p",
    "scree_world_roll_back": "pu", "scree_world_kept_states": "pp", "scree_world_drop_states": "p", "scree_world_snapshot": "pzp",
    "scree_world_reset": "ppz", "scree_world_gravity": "pzp", "scree_world_set_gravity": "pzp", "scree_world_cell": "ppp", "scree_world_wake_copy": "pz",
    "scree_world_read": "ppzz", "scree_world_read_of": "ppzpz", "scree_world_write": "ppzpz", "scree_world_apply": "ppzpz",
    "scree_world_move": "ppzpzi", "scree_world_add_bodies": "ppp", "scree_world_remove_bodies": "ppz", "scree_world_bodies": "ppzp",
    "scree_world_are_valid": "ppzp", "scree_world_wake": "ppz", "scree_world_set_material": "ppzs", "scree_world_set_body": "pzss",
    "scree_world_set_exclusion": "pzzi", "scree_world_set": "pss", "scree_world_explode": "ppff", "scree_world_grip": "pzpppp",
    "scree_world_move_grip": "pzp", "scree_world_release_grip": "pz", "scree_world_view": "pspp", "scree_world_view_count": "pp", "scree_world_row_of": "pzp",
    "scree_world_contacts": "pp", "scree_world_set_events": "pp", "scree_world_take_events": "pp", "scree_world_sensed": "pp",
    "scree_world_set_measures": "psz", "scree_world_measure": "pp", "scree_world_measured": "psp",
    "scree_world_joints": "pp", "scree_world_drives": "pip", "scree_world_set_drives": "ppzipz", "scree_world_set_motors": "ppzipz",
    "scree_world_set_springs": "ppzis", "scree_world_set_joint_coordinates": "ppzipz", "scree_world_apply_joint_forces": "ppzipz",
    "scree_world_add_joint": "psppp", "scree_world_remove_joint": "pz", "scree_world_vehicles": "pp", "scree_world_drive": "pzffff",
    "scree_world_drive_by_route": "pz", "scree_world_reset_upright": "pz", "scree_world_cast_rays": "ppzzpz", "scree_world_rays_hit": "ppzzp",
    "scree_world_cast_rays_through": "ppzzpp", "scree_world_cast_shapes": "pspzzpz", "scree_world_overlaps": "pspzzpp",
    "scree_world_penetrations": "pspzzpp", "scree_world_closest_points": "ppzzpz", "scree_world_debug_drawing": "pppp",
    "scree_world_render": "pp", "scree_world_canvas_name": "pp", "scree_world_suggested_camera": "pp", "scree_pixel_rays": "siipp",
    "scree_png": "piiiip", "scree_world_export": "psiip", "scree_export_close": "p",
    "scree_world_record": "ppp", "scree_recording_count": "pp", "scree_recording_page": "pp", "scree_recording_save": "ps",
    "scree_recording_take": "pip", "scree_recording_stop": "p"}

for _name, _arguments in _SIGNATURES.items():
    _function = getattr(LIBRARY, _name)
    _function.argtypes = [_KINDS[one] for one in _arguments]
    _function.restype = ctypes.c_int
for _name in ("scree_scene_release", "scree_world_release", "scree_view_release", "scree_recording_release"):
    _function = getattr(LIBRARY, _name)
    _function.argtypes = [ctypes.c_void_p]
    _function.restype = None
LIBRARY.scree_close_devices.argtypes = []
LIBRARY.scree_close_devices.restype = None
for _name in ("scree_error_message", "scree_error_place", "scree_version"):
    getattr(LIBRARY, _name).restype = ctypes.c_char_p
LIBRARY.scree_has_vulkan.restype = ctypes.c_int
LIBRARY.scree_command.argtypes = [ctypes.c_int, ctypes.c_void_p]
LIBRARY.scree_command.restype = ctypes.c_int

_ERRORS: "dict[int, Type[Exception]]" = {
    1: ValueError, 2: ValueError, 3: IndexError, 4: SceneError, 5: CheckpointError, 6: OSError, 7: DeviceError, 8: MemoryError, 9: RuntimeError,
    11: RuntimeError, 12: BufferError}


def error_of(result: int) -> Exception:
    """The error of this thread's last call, which returned `result`."""
    message = LIBRARY.scree_error_message().decode()
    if result == 4:
        return SceneError(message, LIBRARY.scree_error_place().decode())
    return _ERRORS.get(result, RuntimeError)(message)


def check(result: int) -> None:
    if result:
        raise error_of(result)


def sized(kind: Type[Any], **given: Any) -> Any:
    """A struct that begins with its size."""
    return kind(size=ctypes.sizeof(kind), **given)
