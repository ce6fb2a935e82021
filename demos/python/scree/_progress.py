# The progress bar of a run.
"""A bar on a terminal or in a notebook; nothing elsewhere."""
from __future__ import annotations

import sys
import time
from typing import Optional


def _is_notebook() -> bool:
    return "ipykernel" in sys.modules


def is_wanted(wish: Optional[bool]) -> bool:
    """Whether a bar is to be shown: as wished; else where someone watches."""
    return wish if wish is not None else (_is_notebook() or sys.stderr.isatty())


def _left(seconds: float) -> str:
    if seconds < 60:
        return f"{seconds:.0f} s left"
    if seconds < 3600:
        return f"{seconds // 60:.0f} min {seconds % 60:.0f} s left"
    return f"{seconds // 3600:.0f} h {seconds % 3600 // 60:.0f} min left"


class Bar:
    """Called with what is done and what there is to do; shows itself after half a second, and goes when it is closed."""

    WIDTH = 24
    PATIENCE = 0.5  # s

    def __init__(self) -> None:
        self._start = time.monotonic()
        self._shown = False

    def __call__(self, done: int, count: int) -> None:
        seconds = time.monotonic() - self._start
        if seconds < self.PATIENCE or done == 0:
            return
        filled = int(self.WIDTH * done / count)
        rate = done / seconds
        bar = "#" * filled + "." * (self.WIDTH - filled)
        text = f"[{bar}] {100 * done // count:3d}%  {done}/{count} steps  {rate:.3g}/s  {_left((count - done) / rate)}"
        sys.stderr.write(f"\r{text:<79}")
        sys.stderr.flush()
        self._shown = True

    def close(self) -> None:
        if self._shown:
            sys.stderr.write("\r" + " " * 79 + "\r")
            sys.stderr.flush()
