# Shapes of bodies, and what else a body is described with.
"""Shapes, filters, tyres and fracture: plain descriptions, in SI units, along the body's y axis where there is one."""
from __future__ import annotations

import dataclasses
import typing
from dataclasses import dataclass, fields
from typing import Any, Dict, List, Optional, Union

import numpy as np
import numpy.typing as npt

from scree._arrays import require_keys

Vector = Union[typing.Sequence[float], npt.NDArray[Any]]


def _plain(value: Any) -> Any:
    """Values as JSON has them."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    if hasattr(value, "to_dict"):
        return value.to_dict()
    return value


class _Described:
    """A description whose fields are the keys of scene files."""

    def __new__(cls, *values: Any, **given: Any) -> Any:
        require_keys(given, [one.name for one in fields(cls)] if dataclasses.is_dataclass(cls) else [], f"scree.{cls.__name__}")
        return super().__new__(cls)

    def to_dict(self) -> Dict[str, Any]:
        """As in a scene file; without what is left out."""
        pairs = ((one.name, getattr(self, one.name)) for one in fields(self))
        return {name: _plain(value) for name, value in pairs if value is not None}


class Shape(_Described):
    """A shape of a body."""

    _key = ""

    def to_dict(self) -> Dict[str, Any]:
        """As in a scene file: {"sphere": {"radius": 0.5}}."""
        return {self._key: super().to_dict()}


@dataclass(frozen=True)
class Sphere(Shape):
    """A ball. radius: m."""

    _key = "sphere"
    radius: float = 0.5


@dataclass(frozen=True)
class Capsule(Shape):
    """A cylinder along y with round ends. radius: m; half_height: m, from the centre to the centre of a cap."""

    _key = "capsule"
    radius: float = 0.3
    half_height: float = 0.3


@dataclass(frozen=True, eq=False)
class Box(Shape):
    """A box. half_extents: (3,), m."""

    _key = "box"
    half_extents: Vector = (0.5, 0.5, 0.5)


@dataclass(frozen=True, eq=False)
class Plane(Shape):
    """An infinite plane, solid behind its normal; for fixed bodies, whose pose it ignores. offset: m, along the normal."""

    _key = "plane"
    normal: Vector = (0.0, 1.0, 0.0)
    offset: float = 0.0


@dataclass(frozen=True)
class Cylinder(Shape):
    """A cylinder along y. radius: m; half_height: m, from the centre to an end."""

    _key = "cylinder"
    radius: float = 0.3
    half_height: float = 0.3


@dataclass(frozen=True)
class Cone(Shape):
    """A cone along y, apex up, its centre of mass a quarter of its height above its base. radius: of the base, m; height: m."""

    _key = "cone"
    radius: float = 0.3
    height: float = 0.6


@dataclass(frozen=True, eq=False)
class Ellipsoid(Shape):
    """An ellipsoid. radii: (3,), semi-axes along x, y and z, m."""

    _key = "ellipsoid"
    radii: Vector = (0.5, 0.3, 0.4)


@dataclass(frozen=True, eq=False)
class Hull(Shape):
    """The convex hull of points. points: (n, 3), m, at least 4 that are not in a plane; simplified to 64 vertices."""

    _key = "hull"
    points: Any = ()


@dataclass(frozen=True)
class Decompose(_Described):
    """Convex parts of a mesh. error: greatest distance between the surfaces, in longest extents of the mesh; parts: at most that
    many; vertices: of a part, at most 64.
    """

    error: float = 0.02
    parts: int = 32
    vertices: int = 64


@dataclass(frozen=True, eq=False)
class Mesh(Shape):
    """A triangle mesh: of a fixed or kinematic body a surface, solid behind its faces; of a dynamic body a solid of convex parts.

    vertices: (n, 3), m; triangles: (m, 3), indices, counter-clockwise seen from outside. Or file: an OBJ, glTF or GLB file,
    whose lengths are multiplied by scale. decompose: how the parts are made, and a solid of a body that is fixed, too.
    """

    _key = "mesh"
    vertices: Any = None
    triangles: Any = None
    file: Optional[str] = None
    scale: Optional[float] = None
    decompose: Optional[Decompose] = None

    def to_dict(self) -> Dict[str, Any]:
        given = super().to_dict()
        if self.file is not None:
            given["mesh"]["file"] = str(self.file)
        return given


@dataclass(frozen=True, eq=False)
class HeightField(Shape):
    """Terrain over a grid, centred on the body; for fixed and kinematic bodies.

    heights: (rows, columns), m, rows along z and columns along x; spacing: m, between neighbours.
    """

    _key = "height_field"
    heights: Any = ((0.0, 0.0), (0.0, 0.0))
    spacing: float = 1.0

    def to_dict(self) -> Dict[str, Any]:
        heights = np.asarray(self.heights, dtype=np.float32)
        if heights.ndim != 2:
            raise ValueError(f"heights: have the shape {heights.shape}, should have (rows, columns)")
        rows, columns = heights.shape
        return {self._key: {"columns": columns, "rows": rows, "spacing": self.spacing, "heights": heights.ravel().tolist()}}


@dataclass(frozen=True)
class Filter(_Described):
    """Which bodies collide: of an equal group above 0 always, of one below 0 never; else if each is in the other's mask."""

    category: int = 1
    mask: int = 0xFFFFFFFF
    group: int = 0


class FilterGroups:
    """Filters by pairs of groups, 0 to 31: all collide until they are kept apart. Bodies without a filter are of group 0.

        groups = scree.FilterGroups()
        groups.separate(DEBRIS, DEBRIS)  # pieces pass through each other
        scene.add(scree.Box(), filter=groups.filter_of(DEBRIS))
    """

    def __init__(self) -> None:
        self._masks = [0xFFFFFFFF] * 32

    def separate(self, a: int, b: int) -> None:
        """Groups a and b never collide, by filters made from now on."""
        for own, other in ((self._checked(a), self._checked(b)), (b, a)):
            self._masks[own] &= ~(1 << other)

    def unite(self, a: int, b: int) -> None:
        """Groups a and b collide again."""
        for own, other in ((self._checked(a), self._checked(b)), (b, a)):
            self._masks[own] |= 1 << other

    def collide(self, a: int, b: int) -> bool:
        """Whether groups a and b collide."""
        return bool(self._masks[self._checked(a)] >> self._checked(b) & 1)

    def filter_of(self, group: int) -> Filter:
        """The filter of a body of a group."""
        return Filter(1 << self._checked(group), self._masks[group])

    @staticmethod
    def _checked(group: int) -> int:
        if not 0 <= group < 32:
            raise IndexError(f"group {group} is not 0 to 31")
        return group


@dataclass(frozen=True)
class Tyre(_Described):
    """Tyre friction, which depends on slip. best_slip: slip of greatest friction; sliding: friction when sliding, relative."""

    best_slip: float = 0.1
    sliding: float = 0.75


@dataclass(frozen=True)
class Fracture(_Described):
    """How a body breaks: past an impulse of one contact (N s) or a momentum of its own (N s), into `pieces`.

    cutting: "voronoi", "boxes" (of a box) or "splinters"; depth: levels, 1 to 4: with 2, pieces break in turn.
    """

    impulse: Optional[float] = None
    momentum: Optional[float] = None
    cutting: str = "voronoi"
    pieces: int = 8
    depth: int = 1
    seed: int = 1


@dataclass(frozen=True, eq=False)
class Part(_Described):
    """A convex part of a compound. position: (3,), m, and orientation: (4,), x, y, z, w, in the body; density: kg/m^3."""

    shape: Shape = dataclasses.field(default_factory=Box)
    position: Vector = (0.0, 0.0, 0.0)
    orientation: Optional[Vector] = None
    density: Optional[float] = None
    filter: Optional[Filter] = None
    role: Optional[str] = None
    material: Optional[Dict[str, Any]] = None


@dataclass(frozen=True, eq=False)
class Compound(Shape):
    """Several convex shapes on one body. Their masses add up; the body's density counts for those without one."""

    _key = "compound"
    parts: List[Part] = dataclasses.field(default_factory=list)
