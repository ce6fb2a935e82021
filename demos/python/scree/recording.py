# Recordings that play in a browser, and their view in a notebook.
"""Recordings: pages that play what a world did, and viewers in the cells of notebooks."""
from __future__ import annotations

import base64
import os
import sys
import typing
from typing import Any, Dict, Optional, Union

from scree import _native
from scree._arrays import count_of
from scree._errors import DeviceError

if typing.TYPE_CHECKING:
    from scree.world import World

_STILL = (640, 360)  # pixels, of the picture where no viewer runs
# Plays from a frame on, as soon as the viewer is there.
_FROM = ("<script>(function go() { if (!window.scree) return void setTimeout(go, 50); window.scree.seek(%d); })()</script>\n")


def _shell() -> Any:
    """The shell of the notebook or of IPython; None elsewhere, and then nothing of IPython is loaded."""
    ipython = sys.modules.get("IPython")
    return None if ipython is None else ipython.get_ipython()


class Recording:
    """What a world did since World.record(), as a page with the viewer; see there."""

    def __init__(self, world: "World", native: "_native.Recording") -> None:
        self._world = world
        self._native = native

    def __len__(self) -> int:
        """Frames so far."""
        return self._native.count()

    def __enter__(self) -> "Recording":
        return self

    def __exit__(self, *error: object) -> None:
        self.stop()

    def stop(self) -> None:
        """Later steps are not recorded; the page stays."""
        self._native.stop()

    def html(self) -> str:
        """The page so far: HTML that needs no other file."""
        return self._native.page()

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the page so far, or raises OSError and leaves no part of it."""
        self._native.save(os.fsdecode(path))

    def view(self, height: int = 480) -> "View":
        """The viewer, `height` pixels high, in a notebook's cell; steps that are recorded later appear in it when their cell is done."""
        return View(self, height)

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> Dict[str, Any]:
        return self.view()._repr_mimebundle_(include, exclude)

    def __repr__(self) -> str:
        return f"<scree.Recording of {len(self)} frames>"


class View:
    """A viewer in a notebook's cell: the page in a frame, over a picture for where no script runs.

    At the end of each later cell in which the world was stepped, it is shown anew with all frames so far, and plays on from where it ended.
    """

    def __init__(self, recording: Recording, height: int = 480) -> None:
        self._recording = recording
        self._height = count_of(height, "height", 16384)
        self._shown = 0  # frames
        self._display: Optional[Any] = None

    @property
    def recording(self) -> Recording:
        """What it shows."""
        return self._recording

    def _still(self) -> Optional[bytes]:
        """The world as it is now, as a PNG file; None where there is nothing to draw it with."""
        try:
            return self._recording._world.render(size=_STILL)._repr_png_()
        except (DeviceError, RuntimeError):
            return None

    def _parts(self) -> Dict[str, Any]:
        frames, page = len(self._recording), self._recording.html()
        if self._shown > 1:
            page = page.replace("</body>", _FROM % (self._shown - 1) + "</body>") if page.count("</body>") == 1 else page
        self._shown = frames
        parts: Dict[str, Any] = {"text/plain": repr(self)}
        picture, image = self._still(), ""
        if picture is not None:
            parts["image/png"] = base64.b64encode(picture).decode()
            image = (f'<img alt="The world at the end of the recording" src="data:image/png;base64,{parts["image/png"]}" '
                     'style="position: absolute; width: 100%; height: 100%; object-fit: cover">')
        quoted = page.replace("&", "&amp;").replace('"', "&quot;")
        parts["text/html"] = (f'<div style="position: relative; width: 100%; height: {self._height}px">{image}<iframe title="A recording of scree" '
                              'sandbox="allow-scripts" style="position: absolute; width: 100%; height: 100%; border: 0" allowfullscreen '
                              f'srcdoc="{quoted}"></iframe></div>')
        return parts

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> Dict[str, Any]:
        return self._parts()

    def _ipython_display_(self) -> None:
        display = sys.modules["IPython"].display  # only IPython asks for this

        if self._display is None:
            self._display = display.display(self._parts(), raw=True, display_id=True)
            shell = _shell()
            if shell is not None:
                shell.events.register("post_run_cell", self._after_cell)
        else:
            self._display.update(self._parts(), raw=True)

    def _after_cell(self, *result: Any) -> None:
        if len(self._recording) > self._shown:
            self.update()

    def update(self) -> None:
        """Shows the frames so far now, rather than at the end of the cell."""
        if self._display is not None:
            self._display.update(self._parts(), raw=True)

    def close(self) -> None:
        """Ends the recording; what is shown stays."""
        shell = _shell()
        if shell is not None and self._display is not None:
            try:
                shell.events.unregister("post_run_cell", self._after_cell)
            except ValueError:  # it was closed before
                pass
        self._recording.stop()

    def __repr__(self) -> str:
        return f"<scree.View of {len(self._recording)} frames; .recording.save(\"run.html\") writes them>"
