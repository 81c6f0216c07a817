"""What draws the 3-D views, and drawing with the processor where card or driver cannot."""

from __future__ import annotations

import logging
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import cast

import PySide6
from PySide6.QtCore import QCoreApplication, Qt
from PySide6.QtGui import QGuiApplication, QOffscreenSurface, QOpenGLContext, QSurfaceFormat
from PySide6.QtWidgets import QApplication, QMessageBox

from insole_core.errors import InsoleError
from insole_core.files.atomic import make_output_folder
from insole_studio.scene.canvas import has_gl
from insole_studio.settings import load_settings, peek_settings, save_settings
from insole_studio.texts import load_language, tr, translate_core_message
from insole_studio.user_paths import UserPaths
from insole_studio.widgets.screen_room import UNSEEN

LEAST_OPENGL = (3, 2)
"""What VTK draws with."""
_RENDERER = 0x1F01
_SOFTWARE = (
    "llvmpipe", "softpipe", "swrast", "software", "gdi generic", "basic render", "swiftshader",
)  # fmt: skip
log = logging.getLogger(__name__)
MESA = {"LIBGL_ALWAYS_SOFTWARE": "1", "__GLX_VENDOR_LIBRARY_NAME": "mesa"}
"""Linux: let Mesa draw with the processor, also where another vendor's library is the default."""
OF_CARD = (
    "LIBGL_DRIVERS_PATH",
    "MESA_LOADER_DRIVER_OVERRIDE",
    "MESA_GL_VERSION_OVERRIDE",
    "MESA_GLSL_VERSION_OVERRIDE",
)
"""What somebody may have set for a graphics card, and must not hold for the processor."""
QT_MESA = "opengl32sw.dll"
"""Windows: Mesa's library, which comes with Qt under this name."""


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
    """
    QCoreApplication.setAttribute(Qt.ApplicationAttribute.AA_ShareOpenGLContexts)
    QSurfaceFormat.setDefaultFormat(_format_of_views())


def _format_of_views() -> QSurfaceFormat:
    """Return what the views of pyvistaqt ask for: only contexts of one format share."""
    shared = QSurfaceFormat()
    shared.setRenderableType(QSurfaceFormat.RenderableType.OpenGL)
    shared.setVersion(*LEAST_OPENGL)
    shared.setProfile(QSurfaceFormat.OpenGLContextProfile.CoreProfile)
    shared.setSwapBehavior(QSurfaceFormat.SwapBehavior.DoubleBuffer)
    for set_bits in (
        shared.setRedBufferSize,
        shared.setGreenBufferSize,
        shared.setBlueBufferSize,
        shared.setAlphaBufferSize,
        shared.setDepthBufferSize,
    ):
        set_bits(8)
    shared.setStencilBufferSize(0)
    shared.setSamples(0)
    return shared


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


def prepare_software_rendering(paths: UserPaths) -> bool:
    """Draw with the processor if the settings say so; called before there is a Qt application.

    Returns
    -------
    bool
        Whether they say so.
    """
    if not peek_settings(paths.settings_file).software_rendering:
        return False
    if sys.platform == "win32":
        _load_mesa(paths.data_folder / "software-rendering")
    else:
        for name in OF_CARD:
            os.environ.pop(name, None)
        os.environ.update(MESA)
    return True


def can_draw(application: QApplication, paths: UserPaths, *, is_software: bool) -> bool:
    """Return whether to go on; else the user was told why not, and what to do was done.

    Parameters
    ----------
    is_software
        Whether the processor draws already.
    """
    if not has_gl():
        return True
    graphics = examine_graphics(QGuiApplication.platformName())
    if graphics is None or graphics.is_enough:
        return True
    load_language(application, peek_settings(paths.settings_file).language)
    return _ask(paths, graphics, is_software=is_software)


def _ask(paths: UserPaths, graphics: Graphics, *, is_software: bool) -> bool:
    """Say what is missing, and offer software rendering where it was not tried."""
    box = QMessageBox()
    box.setWindowTitle(tr("Insole Studio"))
    box.setText(_sentence(graphics))
    restart = None
    if is_software or sys.platform == "darwin":
        box.setInformativeText(
            tr("The processor cannot draw them either: renew the driver of the graphics card.")
            if is_software
            else tr("Renew the system, which brings the driver of the graphics card.")
        )
    else:
        box.setInformativeText(
            tr(
                "With software rendering the processor draws them, more slowly. View ▸ Software "
                "rendering turns it off again once the graphics card has a newer driver."
            )
        )
        restart = box.addButton(
            tr("Restart with software rendering"), QMessageBox.ButtonRole.AcceptRole
        )
    anyway = box.addButton(tr("Start all the same"), QMessageBox.ButtonRole.ActionRole)
    anyway.setToolTip(tr("The program may end by itself as soon as it draws."))
    leave = box.addButton(tr("Quit"), QMessageBox.ButtonRole.RejectRole)
    box.setDefaultButton(restart or leave)
    box.setEscapeButton(leave)
    box.exec()
    chosen = box.clickedButton()
    if restart is not None and chosen is restart:
        _restart_in_software(paths)
    return chosen is anyway


def _sentence(graphics: Graphics) -> str:
    needed = ".".join(map(str, LEAST_OPENGL))
    if graphics.version is None:
        return tr("The 3-D views cannot be drawn: this computer has no OpenGL.")
    found = ".".join(map(str, graphics.version))
    sentence = tr("The 3-D views cannot be drawn: they need OpenGL {needed}, and this is {found}.")
    return sentence.format(needed=needed, found=found)


def _restart_in_software(paths: UserPaths) -> None:
    """Keep the choice, and start the same program again."""
    settings = load_settings(paths.settings_file)
    settings.software_rendering = True
    try:
        save_settings(settings, paths.settings_file)
    except InsoleError as error:
        QMessageBox.warning(None, tr("Insole Studio"), translate_core_message(str(error)))
        return
    environment = {**os.environ, "PYINSTALLER_RESET_ENVIRONMENT": "1"}  # no child of a frozen one
    try:
        subprocess.Popen([sys.executable, *sys.orig_argv[1:]], env=environment)
    except OSError as error:
        log.warning("the program cannot be started again: %s", error)
        sentence = tr("The program could not start itself; start it again.")
        QMessageBox.information(None, tr("Insole Studio"), sentence)


def _load_mesa(folder: Path) -> None:
    """Windows: load Mesa's library first, under the name by which VTK and Qt ask for OpenGL's."""
    bundled = Path(PySide6.__file__).parent / QT_MESA
    copy = folder / "opengl32.dll"
    try:
        make_output_folder(folder)
        if not copy.exists() or copy.stat().st_size != bundled.stat().st_size:
            shutil.copyfile(bundled, copy)
        import ctypes

        ctypes.CDLL(str(copy))
    except (OSError, InsoleError) as error:
        log.warning("Mesa cannot be loaded: %s", error)
        return
    os.environ["QT_OPENGL"] = "desktop"
