# Measures of granular media as arrays.
"""What World.measures() gives."""
from __future__ import annotations

from typing import Any, Dict, List, Mapping, Tuple

import numpy as np
import numpy.typing as npt

Doubles = npt.NDArray[np.float64]


class MeasureTable(Mapping[str, Doubles]):
    """Arrays by name, also attributes: a row of each region, gate, body, grain or cell; vectors are (.., 3), tensors (.., 3, 3).

    names: of the rows, where they have names; row("core") is that row as a dict.
    """

    __slots__ = ("_columns", "names")

    def __init__(self, columns: Dict[str, Doubles], names: List[str]) -> None:
        self._columns = columns
        self.names = names

    def __getitem__(self, name: str) -> Doubles:
        return self._columns[name]

    def __getattr__(self, name: str) -> Doubles:
        try:
            return self._columns[name]
        except KeyError:
            raise AttributeError(f"no measure {name!r}; there are {', '.join(self._columns)}") from None

    def __iter__(self) -> Any:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def row(self, name: str) -> Dict[str, Any]:
        """The row of that name as a dict; KeyError for none."""
        if name not in self.names:
            raise KeyError(f"no row {name!r}; there are {', '.join(map(repr, self.names))}")
        at = self.names.index(name)
        return {column: values[at] for column, values in self._columns.items()}

    def __repr__(self) -> str:
        return f"MeasureTable({', '.join(self._columns)}; rows {self.names})"


class Measures:
    """Measures of the grains of a world at a moment.

    step; time, s. all: a dict, of the grains as a whole. Tables: regions, gates (since the last measures()), bodies (loads), grid
    with arrays of (nz, ny, nx, ..), grains with a row of each body (coordination, rattler, stress). Units are SI; pressure is
    positive in stress, Pa. The guide's page on measures has the definitions.
    """

    __slots__ = ("step", "time", "all", "regions", "gates", "bodies", "grid", "grains")

    def __init__(self, about: Mapping[str, Any], columns: Mapping[str, Doubles]) -> None:
        self.step: int = about["step"]
        self.time: float = about["time"]
        cells: Tuple[int, ...] = tuple(about["cells"])[::-1]

        def table(group: str, names: List[str]) -> MeasureTable:
            made: Dict[str, Doubles] = {}
            for name, width in about["columns"].items():
                of, column = name.split(".")
                if of == group:
                    rows = cells if group == "grid" else (-1,)
                    part = (3, 3) if width == 9 else (width,) if width > 1 else ()
                    made[column] = columns[name].reshape(*rows, *part)
            return MeasureTable(made, names)

        names = about["names"]
        regions = table("regions", names["regions"])
        self.all: Dict[str, Any] = regions.row("all")
        self.regions = MeasureTable({name: values[1:] for name, values in regions.items()}, regions.names[1:])
        self.gates = table("gates", names["gates"])
        self.bodies = table("bodies", names["bodies"])
        self.grid = table("grid", [])
        self.grains = table("grains", [])
