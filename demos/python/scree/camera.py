# Cameras and pictures.
"""Cameras, and pictures with their channels."""
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Dict, Tuple, Union

import numpy as np
import numpy.typing as npt

from scree import _native
from scree._arrays import Floats, json_text
from scree.shapes import Vector

Size = Tuple[int, int]


@dataclass(frozen=True, eq=False)
class Camera:
    """A camera that looks from eye to target, (3,), m, with y up. vertical_fov: degrees.

    orthographic: parallel projection, with the perspective's scale at the target's distance.
    """

    eye: Vector = (8.0, 5.0, 12.0)
    target: Vector = (0.0, 1.0, 0.0)
    vertical_fov: float = 45.0
    orthographic: bool = False

    def to_dict(self) -> Dict[str, Any]:
        """As in a scene file."""
        return {"eye": [float(x) for x in self.eye], "target": [float(x) for x in self.target],
                "vertical_fov": float(self.vertical_fov), "orthographic": bool(self.orthographic)}

    def _text(self) -> str:
        return json_text(self.to_dict(), "/camera")

    def rays(self, size: Size) -> Tuple[Floats, Floats]:
        """Origins and directions, (height, width, 3) each, of the rays through the pixels' centres; for World.cast_rays."""
        return _native.pixel_rays(self._text(), *size)

    @property
    def forward(self) -> npt.NDArray[np.float64]:
        """(3,), unit: the optical axis, along which depth is measured."""
        along = np.subtract(self.target, self.eye, dtype=np.float64)
        made: npt.NDArray[np.float64] = along / np.linalg.norm(along)
        return made

    def world_to_camera(self) -> npt.NDArray[np.float64]:
        """(4, 4), rows: the camera looks along its -z, x to the right, y up."""
        back = -self.forward
        right = np.cross((0.0, 1.0, 0.0), back)
        if np.linalg.norm(right) < 1e-4:
            right = np.cross((0.0, 0.0, -1.0), back)
        right /= np.linalg.norm(right)
        matrix = np.eye(4)
        matrix[:3, :3] = right, np.cross(back, right), back
        matrix[:3, 3] = -matrix[:3, :3] @ np.asarray(self.eye, dtype=np.float64)
        return matrix

    def intrinsics(self, size: Size) -> npt.NDArray[np.float64]:
        """(3, 3) of a perspective camera, for z forward, x to the right and y down; pixels from the upper left corner."""
        width, height = size
        focal = 0.5 * height / np.tan(np.radians(self.vertical_fov) / 2)
        return np.array([[focal, 0, 0.5 * width], [0, focal, 0.5 * height], [0, 0, 1.0]])

    def points(self, depth: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The points of the world that a depth image shows, (height, width, 3), m; not finite where it shows nothing."""
        image = np.asarray(depth, dtype=np.float64)
        origins, directions = self.rays((image.shape[1], image.shape[0]))
        start = origins - np.asarray(self.eye, dtype=np.float64)
        ahead = directions.astype(np.float64) @ self.forward
        with np.errstate(invalid="ignore"):
            way = (image - start @ self.forward) / ahead
            made: npt.NDArray[np.float64] = origins + directions * way[..., None]
        return made


class Picture(Dict[str, npt.NDArray[Any]]):
    """The channels of a picture by name, each also an attribute: picture["depth"] is picture.depth.

    color: (height, width, 3) uint8, sRGB. depth: (height, width) float32, m, along the optical axis, infinite where there is
    nothing. body: (height, width) int32, ids, -1: nothing. part: likewise, parts of compounds and triangles of meshes.
    normal: (height, width, 3) float32, of the world, outward, unit, or 0. flow: (height, width, 2) float32, pixels.
    Rows from the top.
    """

    def __getattr__(self, name: str) -> npt.NDArray[Any]:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f'the picture has no channel "{name}"; it has {", ".join(self) or "none"}') from None

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the colours as a PNG file."""
        write_png(path, self.color)

    def _repr_png_(self) -> bytes:
        return _native.png(self.color)


def write_png(path: Union[str, "os.PathLike[str]"], pixels: npt.NDArray[Any]) -> None:
    """Writes a PNG file: (height, width, 3) uint8 colours, or uint16 numbers of one or three channels (a depth in mm, say)."""
    if pixels.dtype not in (np.uint8, np.uint16):
        raise TypeError(f"write_png: pixels are uint8 or uint16, not {pixels.dtype}")
    if pixels.ndim not in (2, 3) or (pixels.dtype == np.uint8 and pixels.ndim != 3) or (pixels.ndim == 3 and pixels.shape[2] not in (1, 3)):
        raise ValueError(f"write_png: pixels have the shape {pixels.shape}, should have (height, width, 3)")
    with open(path, "wb") as file:
        file.write(_native.png(np.ascontiguousarray(pixels)))
