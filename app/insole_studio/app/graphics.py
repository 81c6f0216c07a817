"""What draws the 3-D views: its name and version, asked without opening a window; its contexts."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from typing import cast

from PySide6.QtCore import QCoreApplication, Qt
from PySide6.QtGui import QOffscreenSurface, QOpenGLContext, QSurfaceFormat

from insole_studio.widgets.screen_room import UNSEEN

LEAST_OPENGL = (3, 2)
"""What VTK draws with."""
_RENDERER = 0x1F01
_SOFTWARE = (
    "llvmpipe", "softpipe", "swrast", "software", "gdi generic", "basic render", "swiftshader",
)  # fmt: skip


@dataclass(frozen=True)
class Graphics:
    """The OpenGL of this computer.

    Parameters
    ----------
    version
        Major and minor number; None where there is no OpenGL.
    """

    version: tuple[int, int] | None
    renderer: str = ""

    @property
    def is_software(self) -> bool:
        """Whether the processor draws, not a graphics card."""
        return any(word in self.renderer.lower() for word in _SOFTWARE)

    @property
    def is_enough(self) -> bool:
        """Whether the 3-D views can be drawn."""
        return self.version is not None and self.version >= LEAST_OPENGL


def share_contexts() -> None:
    """Let a 3-D view keep its OpenGL context; called before there is a Qt application.

    A panel that floats is a window of its own, and so is the one that it comes back to. Qt would
    give the view in it a new context each time, without what VTK has made in the one before.
    That pyvistaqt sets the same format again, Qt remarks as a warning; it changes nothing.
    """
    QCoreApplication.setAttribute(Qt.ApplicationAttribute.AA_ShareOpenGLContexts)
    shared = QSurfaceFormat.defaultFormat()  # as the views will ask for: only such ones share
    shared.setVersion(*LEAST_OPENGL)
    shared.setProfile(QSurfaceFormat.OpenGLContextProfile.CoreProfile)
    QSurfaceFormat.setDefaultFormat(shared)


def examine_graphics(platform: str) -> Graphics | None:
    """Ask for the OpenGL of this computer, in the thread of the window.

    Parameters
    ----------
    platform
        Name of Qt's platform.

    Returns
    -------
    Graphics or None
        None where Qt draws for no screen, and has no OpenGL to ask.
    """
    if platform in UNSEEN:
        return None
    surface = QOffscreenSurface()
    surface.create()
    context = QOpenGLContext()
    if sys.platform == "darwin":  # which else gives an old one, whatever it can do
        core = QSurfaceFormat()
        core.setVersion(*LEAST_OPENGL)
        core.setProfile(QSurfaceFormat.OpenGLContextProfile.CoreProfile)
        context.setFormat(core)
    if not context.create() or not context.makeCurrent(surface):
        return Graphics(None)
    try:
        functions, version = context.functions(), context.format().version()
        renderer = cast("str | None", functions.glGetString(_RENDERER)) or ""
        return Graphics((int(version[0]), int(version[1])), renderer)
    finally:
        context.doneCurrent()
