"""The library of the cameras, imported when it is needed."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from realsense_d400.errors import LibraryMissingError, RealSenseError

_NO_PERMISSION = re.compile(r"access|permission|denied", re.IGNORECASE)
_IN_USE = re.compile(r"busy|in use", re.IGNORECASE)


def library() -> Any:
    """Return the module `pyrealsense2`.

    Raises
    ------
    LibraryMissingError
    """
    try:
        import pyrealsense2
    except ImportError as error:
        raise LibraryMissingError(
            "A RealSense camera needs the library pyrealsense2, which is missing here; install it "
            'with "pip install pyrealsense2", or use another computer if there is none for this '
            "system."
        ) from error
    return pyrealsense2


@contextmanager
def told(camera: str) -> Iterator[None]:
    """Turn what the library raises within a context into a sentence about a camera.

    Parameters
    ----------
    camera
        Its serial number, or the file that it was recorded in.
    """
    try:
        yield
    except RuntimeError as error:
        raise RealSenseError(_sentence(camera, str(error))) from error


def no_permission(camera: str) -> str:
    """Return the sentence that this user may not open a camera."""
    return (
        f"RealSense {camera} may not be opened by this user; install the udev rule "
        "70-realsense.rules that comes with the program, then plug the camera in again."
    )


def _sentence(camera: str, reason: str) -> str:
    if _NO_PERMISSION.search(reason):
        return no_permission(camera)
    if _IN_USE.search(reason):
        return f"RealSense {camera} is used by another program; close that program."
    return f"RealSense {camera} does not answer ({reason}); plug it in again."
