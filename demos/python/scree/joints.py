# Kinds of joints.
"""Kinds of joints: how body b may move against body a. Lengths and forces along an axis are in m and N, about one in rad, N m."""
from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import Any, Dict, Mapping, Optional, Sequence, Tuple, Union

from scree.shapes import _Described


@dataclass(frozen=True)
class Limits(_Described):
    """Limits of a coordinate, m or rad."""

    lower: float = 0.0
    upper: float = 0.0


@dataclass(frozen=True)
class Spring(_Described):
    """A spring and damper towards rest. stiffness: N/m or N m/rad; damping: N s/m or N m s/rad; rest: m or rad; max_force: N or N m.

    speed: m/s or rad/s, towards which it damps.
    """

    stiffness: float = 0.0
    damping: float = 0.0
    rest: float = 0.0
    max_force: Optional[float] = None
    speed: Optional[float] = None


@dataclass(frozen=True)
class Motor(_Described):
    """Drives b against a. speed: m/s or rad/s; max_force: N or N m."""

    speed: float = 0.0
    max_force: float = 0.0


AnyLimits = Union[Limits, Tuple[float, float], None]


def _limits(given: AnyLimits) -> Optional[Limits]:
    return Limits(*given) if isinstance(given, (tuple, list)) else given


@dataclass(frozen=True)
class Axis(_Described):
    """Motion along or about one axis: free, locked, or within limits, (lower, upper); with a spring, a motor or friction.

    armature: kg m^2 or kg, the inertia of a rotor that turns with the axis.
    """

    locked: Optional[bool] = None
    limits: AnyLimits = None
    spring: Optional[Spring] = None
    motor: Optional[Motor] = None
    friction: Optional[float] = None
    armature: Optional[float] = None

    def to_dict(self) -> Dict[str, Any]:
        given = super().to_dict()
        limits = _limits(self.limits)
        if limits is not None:
            given["limits"] = limits.to_dict()
        return given


class JointKind(_Described):
    """A kind of joint."""

    _key = ""

    def to_dict(self) -> Dict[str, Any]:
        """As in a scene file: {"hinge": {}}."""
        return {self._key: super().to_dict()}


@dataclass(frozen=True)
class Ball(JointKind):
    """The anchors coincide. friction: N m about each axis."""

    _key = "ball"
    friction: Optional[float] = None


@dataclass(frozen=True)
class _OneAxis(JointKind):
    limits: AnyLimits = None
    spring: Optional[Spring] = None
    motor: Optional[Motor] = None
    friction: Optional[float] = None
    armature: Optional[float] = None

    def to_dict(self) -> Dict[str, Any]:
        """As in a scene file: {"hinge": {"limits": {...}}}."""
        return {self._key: Axis(None, self.limits, self.spring, self.motor, self.friction, self.armature).to_dict()}


class Hinge(_OneAxis):
    """b turns about the joint's axis. limits: (lower, upper), rad."""

    _key = "hinge"


class Slider(_OneAxis):
    """b slides along the joint's axis. limits: (lower, upper), m."""

    _key = "slider"


class Fixed(JointKind):
    """No motion of b against a."""

    def to_dict(self) -> Dict[str, Any]:
        """As in a scene file."""
        return {"fixed": {}}


@dataclass(frozen=True)
class Distance(JointKind):
    """Between two anchors: a rope (0 to its length), a rod (both equal), or a spring. least, greatest: m."""

    _key = "distance"
    least: float = 0.0
    greatest: Optional[float] = None
    spring: Optional[Spring] = None


@dataclass(frozen=True)
class ConeTwist(JointKind):
    """The anchors coincide; b's x axis stays within a cone about a's. swing: half its angle, rad; twist: (lower, upper), rad."""

    _key = "cone_twist"
    swing: float = 0.0
    twist: Union[Limits, Tuple[float, float]] = (0.0, 0.0)
    friction: Optional[float] = None

    def to_dict(self) -> Dict[str, Any]:
        given = super().to_dict()
        limits = _limits(self.twist)
        given[self._key]["twist"] = (limits or Limits()).to_dict()
        return given


@dataclass(frozen=True)
class SixDof(JointKind):
    """Each axis as given; free by default: along x, y and z, the twist about x, the swing about y and z."""

    _key = "six_degrees"
    x: Axis = dataclasses.field(default_factory=Axis)
    y: Axis = dataclasses.field(default_factory=Axis)
    z: Axis = dataclasses.field(default_factory=Axis)
    twist: Axis = dataclasses.field(default_factory=Axis)
    swing_y: Axis = dataclasses.field(default_factory=Axis)
    swing_z: Axis = dataclasses.field(default_factory=Axis)


@dataclass(frozen=True)
class Coupling(JointKind):
    """Couples the axes of other joints: the sum of factor times coordinate, less offset, is 0. It has no bodies and no anchor.

    joints: {joint: factor} or [(joint, factor), (joint, factor, "twist"), ...], each an index or a name: gears of 20 and 40 teeth that
    mesh are {"left": 20, "right": 40}; a finger that follows another, {"right": 1, "left": -1}. curve: of the last joint in place of its
    factor, the coefficients of its coordinate's first power to the fourth. offset: None for the sum at the start. With limits, spring,
    motor or friction the sum moves by these: a tendon.
    """

    _key = "coupling"
    joints: Union[Mapping[Union[int, str], float], Sequence[Tuple[Any, ...]]] = ()
    curve: Optional[Sequence[float]] = None
    offset: Optional[float] = None
    limits: AnyLimits = None
    spring: Optional[Spring] = None
    motor: Optional[Motor] = None
    friction: Optional[float] = None

    def to_dict(self) -> Dict[str, Any]:
        """As in a scene file: {"coupling": {"joints": [{"joint": "left", "factor": 20}, ...]}}."""
        pairs = self.joints.items() if isinstance(self.joints, Mapping) else self.joints
        given: Dict[str, Any] = {"joints": [dict(zip(("joint", "factor", "axis"), one)) for one in pairs]}
        if self.curve is not None:
            given["curve"] = [float(one) for one in self.curve]
        if self.offset is not None:
            given["offset"] = float(self.offset)
        given.update(Axis(None, self.limits, self.spring, self.motor, self.friction).to_dict())
        return {self._key: given}
