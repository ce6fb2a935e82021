# Errors of scree, which are of Python's kinds.
"""Errors of scree. Indices out of range are IndexError, unknown names KeyError, files that cannot be read or written OSError."""


class SceneError(ValueError):
    """A scene that cannot be: `pointer` is the JSON pointer of the value, such as "/bodies/17/shape/sphere/radius"."""

    pointer: str

    def __init__(self, message: str, pointer: str = "") -> None:
        super().__init__(message)
        self.pointer = pointer


class CheckpointError(ValueError):
    """A saved state that is damaged, of another format, or of another scene."""


class DeviceError(RuntimeError):
    """A device or driver that is missing or failed; the message names the package that helps."""
