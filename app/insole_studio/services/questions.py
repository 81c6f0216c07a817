"""Questions to the user; all go through one object, so that tests can answer."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum, auto
from pathlib import Path

from PySide6.QtWidgets import (
    QDialog,
    QFileDialog,
    QInputDialog,
    QLineEdit,
    QMessageBox,
    QWidget,
)

from insole_core.geometry.side import Side
from insole_studio.services.file_kinds import complete_name
from insole_studio.services.last_folders import Kept, LastFolders
from insole_studio.services.scan_dialog import ScanAnswer, ScanDialog
from insole_studio.settings import Settings
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.fields_dialog import Field, FieldsDialog


class Answer(Enum):
    """What to do with unsaved work."""

    SAVE = auto()
    DISCARD = auto()
    CANCEL = auto()


class SameSide(Enum):
    """What to do with a scan of a foot that the case already has."""

    REPLACE = auto()
    NEW_CASE = auto()
    CANCEL = auto()


class InUse(Enum):
    """How to open a case that another window has open."""

    READ_ONLY = auto()
    COPY = auto()
    CANCEL = auto()


class Unsaved(Enum):
    """What to do when a case could not be saved."""

    ELSEWHERE = auto()
    REPLACE = auto()
    GO_ON = auto()


class Questions:
    """Questions with verbs on their buttons; None means cancelled.

    Parameters
    ----------
    parent
        The window that the questions come from.
    folders
        The folders that file dialogs start in; by default they are forgotten with the questions.
    """

    def __init__(self, parent: QWidget, folders: LastFolders | None = None) -> None:
        self._parent = parent
        self._folders = folders or LastFolders(Settings())

    def on(self, window: QWidget) -> Questions:
        """Return the same questions for another window: each is asked on the one it comes from."""
        return Questions(window, self._folders)

    def about_scan(self, path: Path, trouble: str = "") -> ScanAnswer | None:
        """Ask which foot a mesh shows, and in which unit.

        Parameters
        ----------
        path
            Of the mesh.
        trouble
            Why it could not be read as it was answered before.
        """
        dialog = ScanDialog(path.name, translate_core_message(trouble), self._parent)
        dialog.exec()
        return dialog.answer

    def which_side_after_all(self, sentence: str, asked: Side) -> Side | None:
        """Ask for the side of a foot whose shape is that of the other one.

        Parameters
        ----------
        sentence
            What the shape shows.
        asked
            The side that it was said to be.
        """
        box = self._box(sentence)
        verbs = {Side.LEFT: tr("Open as a left foot"), Side.RIGHT: tr("Open as a right foot")}
        other = box.addButton(verbs[asked.other], QMessageBox.ButtonRole.AcceptRole)
        same = box.addButton(verbs[asked], QMessageBox.ButtonRole.DestructiveRole)
        stop = box.addButton(tr("Do not open"), QMessageBox.ButtonRole.RejectRole)
        box.setDefaultButton(stop)
        box.exec()
        return {other: asked.other, same: asked}.get(box.clickedButton())  # type: ignore[call-overload]

    def open_anyway(self, sentence: str) -> bool:
        """Ask whether to continue although the shape is that of the other foot."""
        box = self._box(sentence)
        anyway = box.addButton(tr("Open anyway"), QMessageBox.ButtonRole.AcceptRole)
        stop = box.addButton(tr("Do not open"), QMessageBox.ButtonRole.RejectRole)
        box.setDefaultButton(stop)
        box.exec()
        return box.clickedButton() is anyway

    def about_unsaved(self, name: str) -> Answer:
        """Ask what to do with unsaved work."""
        box = self._box(tr("{name} has changes that are not saved.").format(name=name))
        save = box.addButton(tr("Save"), QMessageBox.ButtonRole.AcceptRole)
        discard = box.addButton(tr("Discard changes"), QMessageBox.ButtonRole.DestructiveRole)
        box.addButton(tr("Go on working"), QMessageBox.ButtonRole.RejectRole)
        box.setDefaultButton(save)
        box.exec()
        clicked = box.clickedButton()
        if clicked is save:
            return Answer.SAVE
        return Answer.DISCARD if clicked is discard else Answer.CANCEL

    def about_same_side(self, side: Side) -> SameSide:
        """Ask what to do with a second scan of the same foot."""
        sentence = {
            Side.LEFT: tr("The case has a left foot already."),
            Side.RIGHT: tr("The case has a right foot already."),
        }
        box = self._box(sentence[side])
        box.setInformativeText(
            tr("With the new scan in its place, the design can be repeated in one click.")
        )
        place = box.addButton(tr("Put in its place"), QMessageBox.ButtonRole.AcceptRole)
        new = box.addButton(tr("Begin a new case"), QMessageBox.ButtonRole.ActionRole)
        box.addButton(tr("Do not open"), QMessageBox.ButtonRole.RejectRole)
        box.setDefaultButton(place)
        box.exec()
        if box.clickedButton() is place:
            return SameSide.REPLACE
        return SameSide.NEW_CASE if box.clickedButton() is new else SameSide.CANCEL

    def about_case_in_use(self, sentence: str) -> InUse:
        """Ask how to open a case that another window has open."""
        box = self._box(sentence)
        box.setInformativeText(
            tr("Look at it without changing its file, or go on with a copy under another name.")
        )
        read = box.addButton(tr("Open read-only"), QMessageBox.ButtonRole.AcceptRole)
        copy = box.addButton(tr("Open a copy"), QMessageBox.ButtonRole.ActionRole)
        box.addButton(tr("Do not open"), QMessageBox.ButtonRole.RejectRole)
        box.setDefaultButton(read)
        box.exec()
        if box.clickedButton() is read:
            return InUse.READ_ONLY
        return InUse.COPY if box.clickedButton() is copy else InUse.CANCEL

    def about_failed_save(self, sentence: str) -> Unsaved:
        """Ask what to do with a case that could not be saved."""
        box = self._box(sentence)
        box.setIcon(QMessageBox.Icon.Warning)
        box.setInformativeText(tr("Nothing is lost: the case stays open, and is not saved yet."))
        elsewhere = box.addButton(tr("Save as…"), QMessageBox.ButtonRole.AcceptRole)
        box.addButton(tr("Go on working"), QMessageBox.ButtonRole.RejectRole)
        box.setDefaultButton(elsewhere)
        box.exec()
        return Unsaved.ELSEWHERE if box.clickedButton() is elsewhere else Unsaved.GO_ON

    def about_changed_file(self, sentence: str) -> Unsaved:
        """Ask what to do with a case whose file another program has changed."""
        box = self._box(sentence)
        box.setIcon(QMessageBox.Icon.Warning)
        box.setInformativeText(tr("Saving here would discard what was changed there."))
        elsewhere = box.addButton(tr("Save as…"), QMessageBox.ButtonRole.AcceptRole)
        replace = box.addButton(tr("Replace the file"), QMessageBox.ButtonRole.DestructiveRole)
        box.addButton(tr("Go on working"), QMessageBox.ButtonRole.RejectRole)
        box.setDefaultButton(elsewhere)
        box.exec()
        if box.clickedButton() is elsewhere:
            return Unsaved.ELSEWHERE
        return Unsaved.REPLACE if box.clickedButton() is replace else Unsaved.GO_ON

    def text(self, title: str, question: str, value: str) -> str | None:
        """Ask for a line of text.

        Parameters
        ----------
        value
            The initial text.

        Returns
        -------
        str or None
            None if the user cancelled.
        """
        text, is_given = QInputDialog.getText(
            self._parent, title, question, QLineEdit.EchoMode.Normal, value
        )
        return text.strip() if is_given else None

    def fields(self, title: str, sentence: str, fields: Sequence[Field]) -> dict[str, str] | None:
        """Ask for several lines of text.

        Returns
        -------
        dict or None
            The texts by key; None if the user cancelled.
        """
        dialog = FieldsDialog(title, sentence, fields, self._parent)
        is_given = dialog.exec() == QDialog.DialogCode.Accepted
        texts = dialog.texts()
        dialog.deleteLater()
        return texts if is_given else None

    def may_replace(self, paths: Sequence[Path]) -> bool:
        """Ask whether existing files may be replaced."""
        names = ", ".join(path.name for path in paths)
        box = self._box(tr("These files are there already: {names}").format(names=names))
        replace = box.addButton(tr("Replace them"), QMessageBox.ButtonRole.AcceptRole)
        keep = box.addButton(tr("Keep them"), QMessageBox.ButtonRole.RejectRole)
        box.setDefaultButton(keep)
        box.exec()
        return box.clickedButton() is replace

    def may_discard(self, name: str) -> bool:
        """Ask whether recovered work may be discarded for good."""
        text = tr("What was recovered of {name} and not saved will be gone for good.")
        box = self._box(text.format(name=name))
        discard = box.addButton(tr("Discard it"), QMessageBox.ButtonRole.DestructiveRole)
        keep = box.addButton(tr("Keep it"), QMessageBox.ButtonRole.RejectRole)
        box.setDefaultButton(keep)
        box.exec()
        return box.clickedButton() is discard

    def folder_to_open(self, title: str, kept: Kept) -> Path | None:
        """Ask for a folder.

        Parameters
        ----------
        title
            Of the dialog.
        kept
            What is in the folder; the next dialog for it starts beside the folder.
        """
        start = str(self._folders.of(kept))
        name = QFileDialog.getExistingDirectory(self._parent, title, start)
        return self._remembered(kept, Path(name)) if name else None

    def file_to_open(self, kinds: str, kept: Kept) -> Path | None:
        """Ask for a file.

        Parameters
        ----------
        kinds
            Filter of the file dialog.
        kept
            What the file holds; the next dialog for it starts in the same folder.
        """
        start = str(self._folders.of(kept))
        name, _ = QFileDialog.getOpenFileName(self._parent, tr("Open"), start, kinds)
        return self._remembered(kept, Path(name)) if name else None

    def file_to_write(self, suggestion: str, kinds: str, kept: Kept) -> Path | None:
        """Ask for a path to write to, and whether what is there may be replaced.

        Parameters
        ----------
        suggestion
            The proposed file name.
        kinds, kept
            As for `file_to_open`.
        """
        while (path := self.name_to_write(suggestion, kinds, kept)) is not None:
            if not path.exists() or self.may_replace([path]):
                return path
        return None

    def name_to_write(self, suggestion: str, kinds: str, kept: Kept) -> Path | None:
        """Ask for a path to write to or to derive others from; replacing is not asked.

        The dialog's own question would be about the name as typed, which may not be the one that
        is written.

        Parameters
        ----------
        suggestion, kinds, kept
            As for `file_to_write`.
        """
        name, chosen = QFileDialog.getSaveFileName(
            self._parent, tr("Save"), str(self._folders.of(kept) / suggestion), kinds,
            options=QFileDialog.Option.DontConfirmOverwrite,
        )  # fmt: skip
        if not name:
            return None
        return self._remembered(kept, complete_name(Path(name), kinds, chosen))

    def _remembered(self, kept: Kept, path: Path) -> Path:
        self._folders.remember(kept, path.parent)
        return path

    def _box(self, text: str) -> QMessageBox:
        box = QMessageBox(self._parent)
        box.setWindowTitle(tr("Insole Studio"))
        said = translate_core_message(text)
        box.setText(said[:1].upper() + said[1:])
        return box
