"""The window led by a program: for the demonstration, screenshots, and journeys in tests."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from types import TracebackType

from PySide6.QtCore import QEventLoop, QPoint
from PySide6.QtGui import QImage, QPainter
from PySide6.QtWidgets import QWidget

from insole_core.errors import OutputError
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import Pelott
from insole_studio.app.bootstrap import (
    DEFAULT_SIZE,
    Application,
    UserPaths,
    build_application,
    qt_application,
)
from insole_studio.app.scripted_answers import AnsweredQuestions, ScriptedAnswers
from insole_studio.scene.scene_view import SceneView
from insole_studio.texts import tr


class ScriptedStudio:
    """The real window, led by a program: for the demonstration, screenshots and journeys.

    Use it as a context; inside, every call returns when its work is done.

    Parameters
    ----------
    places
    size
        Of the window, pixels.
    dark
    answers
        To what the window would ask somebody; by default unsaved work is left behind.
    """

    def __init__(
        self,
        places: UserPaths,
        size: tuple[int, int] = DEFAULT_SIZE,
        dark: bool = False,
        answers: ScriptedAnswers | None = None,
    ) -> None:
        self._qt = qt_application()
        self.app = build_application(self._qt, places)
        self.app.studio.rooms.appearance.set_dark(dark)
        self.answers = answers or ScriptedAnswers()
        self.app.studio.rooms.messages.questions = AnsweredQuestions(self.app.window, self.answers)
        self.app.window.resize(*size)
        self.app.window.arrange()

    def __enter__(self) -> ScriptedStudio:
        self.app.window.show()
        self.settle()
        return self

    def __exit__(
        self,
        _kind: type[BaseException] | None,
        _error: BaseException | None,
        _trace: TracebackType | None,
    ) -> None:
        self.app.autosave.forget()
        self.app.close()
        self._qt.processEvents()

    def open(self, path: Path, side: Side | None = None) -> None:
        """Open a case, a session, or a mesh with its side."""
        self.app.studio.rooms.opening.open_path(path, side)
        self.settle()

    def place_pelott(self, x_mm: float, y_mm: float, height_mm: float = 6.0) -> None:
        """Put a pelott under a place of the insole frame and select it."""
        case = self.app.case
        design = case.record.design
        if design is None:
            raise RuntimeError("a pelott needs an open foot")
        pad = Pelott(centre_mm=(x_mm, y_mm), height_mm=height_mm)
        self.app.studio.rooms.editing.take_tool("pelott")
        case.apply(design.with_added(pad), tr("Place a pelott"))
        case.select(pad.id)
        self.settle()

    def export(self, path: Path) -> None:
        """Write the STL file."""
        self.app.studio.rooms.exporting.export_to(path)
        self.settle()

    def save(self, path: Path) -> None:
        """Write the case file."""
        self.app.studio.rooms.saving.save_to(path)
        self.settle()

    def screenshot(self, path: Path) -> None:
        """Write a picture of the whole window as PNG."""
        self.settle()
        if not grab_window(self.app).save(str(path)):
            raise OutputError("{path} cannot be written; choose another place.", path=path)

    def settle(self) -> None:
        """Wait until all work is done and shown."""
        self._qt.processEvents()
        while self.app.jobs.is_running():
            loop = QEventLoop()
            self.app.jobs.ended.connect(loop.quit)
            loop.exec()
        self._qt.processEvents()


def grab_window(app: Application) -> QImage:
    """Give a picture of the window with its 3-D views, which Qt alone cannot see."""
    return grab(app.window, (app.stage.insole.scene, app.stage.foot.scene))


def grab(window: QWidget, scenes: Iterable[SceneView]) -> QImage:
    """Give a picture of a window with those of its 3-D views that are seen."""
    image = window.grab().toImage()
    painter = QPainter(image)
    for scene in scenes:
        if scene.isVisible():
            picture = scene.picture()
            picture.setDevicePixelRatio(image.devicePixelRatio())
            painter.drawImage(scene.surface.mapTo(window, QPoint(0, 0)), picture)
    painter.end()
    return image
