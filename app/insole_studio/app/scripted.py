"""Drive the real window from a program: demonstrations, screenshots and end-to-end tests."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType

from PySide6.QtCore import QEventLoop, QPoint
from PySide6.QtGui import QImage, QPainter
from PySide6.QtWidgets import QApplication, QWidget

from insole_core.errors import OutputError
from insole_core.files.atomic import replacing_file
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_studio.app.bootstrap import (
    DEFAULT_SIZE,
    Application,
    build_application,
    qt_application,
)
from insole_studio.jobs import Jobs
from insole_studio.scene.scene_view import SceneView
from insole_studio.services.files import Kept, complete_name
from insole_studio.services.questions import (
    Answer,
    InUse,
    Namesake,
    OtherFoot,
    Questions,
    SameSide,
    Unsaved,
)
from insole_studio.texts import tr
from insole_studio.user_paths import UserPaths
from insole_studio.widgets.form_parts import Field


@dataclass
class ScriptedAnswers:
    """The predefined answers; may be changed between two steps.

    Parameters
    ----------
    unsaved
        What to do with unsaved work when another case is opened.
    same_side
        What to do with a second scan of a side that the case already has.
    in_use
        How to open a case that another window has open.
    failed_save
        What to do when a case cannot be saved.
    anyway
        Whether to continue despite a warning.
    replace
        Whether existing files may be overwritten.
    typed
        A line of text; None cancels.
    path
        A file or folder to open or to write; None cancels.
    fields
        Several lines of text by key; None cancels.
    """

    unsaved: Answer = Answer.DISCARD
    same_side: SameSide = SameSide.REPLACE
    in_use: InUse = InUse.CANCEL
    failed_save: Unsaved = Unsaved.GO_ON
    anyway: bool = False
    replace: bool = False
    typed: str | None = None
    path: Path | None = None
    fields: dict[str, str] | None = None


class _AnsweredQuestions(Questions):
    """Questions answered from a `ScriptedAnswers`."""

    def __init__(self, parent: QWidget, answers: ScriptedAnswers) -> None:
        super().__init__(parent)
        self.answers = answers

    def on(self, window: QWidget) -> _AnsweredQuestions:
        """Return the same answers for another window."""
        return _AnsweredQuestions(window, self.answers)

    def open_anyway(self, _sentence: str) -> bool:
        """Return whether to continue."""
        return self.answers.anyway

    def about_other_foot(self, _sentence: str, _shown: Side) -> OtherFoot:
        """Return whether to insist on the side that was said."""
        return OtherFoot.INSIST if self.answers.anyway else OtherFoot.CANCEL

    def use_unfinished(self, _sentence: str) -> bool:
        """Return whether to use a capture that lacks views."""
        return self.answers.anyway

    def make_alone(self, _sentence: str, _side: Side) -> bool:
        """Return whether to make one foot of two."""
        return self.answers.anyway

    def about_unsaved(self, _name: str) -> Answer:
        """Return what to do with unsaved work."""
        return self.answers.unsaved

    def about_result(self, _step: str) -> Answer:
        """Return what to do with a result of the calibration."""
        return self.answers.unsaved

    def about_namesake(self, _person: str, _same: str, _another: str) -> Namesake:
        """Return whether a namesake of somebody who is there is added all the same."""
        return Namesake.ANOTHER if self.answers.anyway else Namesake.CANCEL

    def about_same_side(self, _side: Side, _order: str = "") -> SameSide:
        """Return what to do with a second scan of the same side."""
        return self.answers.same_side

    def about_case_in_use(self, _sentence: str) -> InUse:
        """Return how to open a case that another window has open."""
        return self.answers.in_use

    def about_failed_save(self, _sentence: str) -> Unsaved:
        """Return what to do when a case cannot be saved."""
        return self.answers.failed_save

    def about_changed_file(self, _sentence: str) -> Unsaved:
        """Return what to do when the file of a case has changed."""
        return self.answers.failed_save

    def text(self, _title: str, _question: str, _value: str) -> str | None:
        """Return the line of text."""
        return self.answers.typed

    def fields(
        self, _title: str, _sentence: str, _fields: Sequence[Field]
    ) -> dict[str, str] | None:
        """Return the lines of text."""
        return self.answers.fields

    def may_replace(self, _paths: Sequence[Path]) -> bool:
        """Return whether existing files may be overwritten."""
        return self.answers.replace

    def may_replace_own(self, _name: str) -> bool:
        """Return whether a device or form of the clinic may be replaced: if existing files may."""
        return self.answers.replace

    def may_discard(self, _name: str) -> bool:
        """Return whether recovered work may be discarded: if unsaved work is."""
        return self.answers.unsaved is Answer.DISCARD

    def may_lose_corrections(self, _sentence: str) -> bool:
        """Return whether a foot may lose corrections: if unsaved work may be."""
        return self.answers.unsaved is Answer.DISCARD

    def may_remove_sample(self) -> bool:
        """Return whether the sample patient may be removed: if unsaved work may be."""
        return self.answers.unsaved is Answer.DISCARD

    def folder_to_open(self, _title: str, _kept: Kept) -> Path | None:
        """Return the path."""
        return self.answers.path

    def file_to_open(self, _kinds: str, _kept: Kept) -> Path | None:
        """Return the path."""
        return self.answers.path

    def file_to_write(self, suggestion: str, kinds: str, kept: Kept) -> Path | None:
        """Return the completed path, unless a file is there that must not be overwritten."""
        path = self.name_to_write(suggestion, kinds, kept)
        return None if path is None or (path.exists() and not self.answers.replace) else path

    def name_to_write(self, _suggestion: str, kinds: str, _kept: Kept) -> Path | None:
        """Return the path, completed as in the dialog."""
        path = self.answers.path
        return None if path is None else complete_name(path, kinds)


class ScriptedWindow:
    """The real window, driven by a program.

    A context manager; inside, every call returns when its work is done.

    Parameters
    ----------
    paths
        The files and folders of the user.
    size
        Width and height of the window, pixels.
    dark
        Whether to use the dark theme.
    answers
        Answers to the window's questions; by default unsaved work is discarded.
    emulate
        Recorded session to play back as live sensors.
    """

    def __init__(
        self,
        paths: UserPaths,
        size: tuple[int, int] = DEFAULT_SIZE,
        dark: bool = False,
        answers: ScriptedAnswers | None = None,
        emulate: Path | None = None,
    ) -> None:
        self._qt = qt_application()
        self.app = build_application(self._qt, paths, emulate)
        self.app.main.appearance.set_dark(dark)
        self.answers = answers or ScriptedAnswers()
        self.app.services.messages.questions = _AnsweredQuestions(self.app.window, self.answers)
        self.app.window.resize(*size)
        self.app.window.arrange()

    def __enter__(self) -> ScriptedWindow:
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
        self.app.features.case_files.opener.open_path(path, side)
        self.settle()

    def place_pelott(self, x_mm: float, y_mm: float, height_mm: float = 6.0) -> None:
        """Place a pelott at (x, y) in the insole frame and select it.

        Parameters
        ----------
        x_mm, y_mm
            Apex of the pelott, mm.
        height_mm
            Height of the apex, mm.
        """
        case = self.app.case
        design = case.record.design
        if design is None:
            raise RuntimeError("a pelott needs an open foot")
        pad = Pelott(centre_mm=(x_mm, y_mm), height_mm=height_mm)
        self.app.features.design.edit.take_tool("pelott")
        case.apply(design.with_added(pad), tr("Place a pelott"))
        case.select(pad.id)
        self.settle()

    def export(self, path: Path) -> tuple[Path, ...]:
        """Export with the default order of the export stage.

        Parameters
        ----------
        path
            Path from which the names of all files are derived.

        Returns
        -------
        tuple of Path
            The files of the solids, whose names contain the side.

        Raises
        ------
        OutputError
            If nothing was written; the sentence is the one that was told.
        """
        self.answers.path = path
        return export_at_stage(self.app)

    def save(self, path: Path) -> None:
        """Write the case file."""
        self.app.features.case_files.saver.save_to(path)
        self.settle()

    def screenshot(self, path: Path) -> None:
        """Save an image of the whole window as PNG."""
        self.settle()
        with replacing_file(path) as beside:
            if not grab_window(self.app).save(str(beside)):
                raise OutputError("{path} cannot be written; choose another place.", path=path)

    def settle(self) -> None:
        """Wait until all jobs are done and their results shown."""
        wait_for(self.app.jobs)


def wait_for(jobs: Jobs) -> None:
    """Wait until all jobs have delivered their results and these are shown."""
    QApplication.processEvents()
    while jobs.is_running():
        loop = QEventLoop()
        jobs.ended.connect(loop.quit)
        loop.exec()
    QApplication.processEvents()


def export_at_stage(app: Application) -> tuple[Path, ...]:
    """Open the export stage, export its default order, and close it.

    The scripted answers must contain the path to write to.

    Returns
    -------
    tuple of Path
        The files of the solids.

    Raises
    ------
    OutputError
        If nothing was written; the sentence is the one that was told.
    """
    app.features.export.open()
    stage = app.features.export.stage
    assert stage is not None
    written: list[Path] = []
    stage.exported.connect(lambda _record, ordered: written.extend(ordered.paths))
    wait_for(stage.jobs)
    known = list(app.services.messages.dialogs)
    stage.view.export.click()
    wait_for(stage.jobs)
    told = [one.text() for one in app.services.messages.dialogs if one not in known]
    sentence = " ".join(told) or stage.view.error.text()
    stage.close()
    app.window.activateWindow()  # as a window manager does when another window has closed
    wait_for(app.jobs)
    if not written:
        raise OutputError(sentence or "Nothing was exported, because a check does not allow it.")
    return tuple(written)


def grab_window(app: Application) -> QImage:
    """Return an image of the window with its 3-D views, which Qt alone cannot grab."""
    return grab(app.window, (app.stage.insole.scene, app.stage.foot.scene))


def grab(window: QWidget, scenes: Iterable[SceneView]) -> QImage:
    """Return an image of a window, composed with those of its 3-D views that are visible."""
    image = window.grab().toImage()
    painter = QPainter(image)
    for scene in scenes:
        if scene.isVisible():
            picture = scene.picture()
            picture.setDevicePixelRatio(image.devicePixelRatio())
            painter.drawImage(scene.surface.mapTo(window, QPoint(0, 0)), picture)
    painter.end()
    return image
