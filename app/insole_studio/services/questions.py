"""Questions to the user; all go through one object, so that tests can answer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum, auto
from pathlib import Path
from typing import Generic, TypeVar

from PySide6.QtWidgets import (
    QAbstractButton,
    QDialog,
    QFileDialog,
    QInputDialog,
    QLineEdit,
    QMessageBox,
    QWidget,
)

from insole_core.files.write_errors import is_there
from insole_core.geometry.side import Side
from insole_studio.services.files import Kept, LastFolders, complete_name
from insole_studio.settings import Settings
from insole_studio.texts import tr, translate_core_message, with_capital
from insole_studio.widgets.form_parts import Field, FieldsDialog


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


class OtherFoot(Enum):
    """What to do with a capture whose shape is that of the other foot than was said."""

    TAKE = auto()
    INSIST = auto()
    CANCEL = auto()


class InUse(Enum):
    """How to open a case that another window has open."""

    READ_ONLY = auto()
    COPY = auto()
    CANCEL = auto()


class Namesake(Enum):
    """What to do with a new patient whose name and birth date somebody in the record has."""

    SAME = auto()
    ANOTHER = auto()
    CANCEL = auto()


class Unsaved(Enum):
    """What to do when a case could not be saved."""

    ELSEWHERE = auto()
    REPLACE = auto()
    GO_ON = auto()


Chosen = TypeVar("Chosen")
_UNBROKEN_HYPHEN = "\N{NON-BREAKING HYPHEN}"
_ACCEPT = QMessageBox.ButtonRole.AcceptRole
_ACT = QMessageBox.ButtonRole.ActionRole
_DESTRUCT = QMessageBox.ButtonRole.DestructiveRole
_REJECT = QMessageBox.ButtonRole.RejectRole


@dataclass(frozen=True)
class _Choice(Generic[Chosen]):
    """A button, and the answer that it stands for."""

    verb: str
    answer: Chosen
    role: QMessageBox.ButtonRole


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

    def open_anyway(self, sentence: str) -> bool:
        """Ask whether to continue although the feet contradict their places."""
        choices = [
            _Choice(tr("Open anyway"), True, _ACCEPT),
            _Choice(tr("Do not open"), False, _REJECT),
        ]
        return self._choose(sentence, choices, default=False)

    def about_other_foot(self, sentence: str, shown: Side) -> OtherFoot:
        """Ask which foot it is, whose shape is not that of the side that was said.

        Parameters
        ----------
        shown
            The side that the shape shows.
        """
        take = {
            Side.LEFT: tr("Take it as a left foot"),
            Side.RIGHT: tr("Take it as a right foot"),
        }
        choices = [
            _Choice(take[shown], OtherFoot.TAKE, _ACCEPT),
            _Choice(tr("Open anyway"), OtherFoot.INSIST, _ACT),
            _Choice(tr("Do not open"), OtherFoot.CANCEL, _REJECT),
        ]
        return self._choose(sentence, choices, default=OtherFoot.TAKE)

    def use_unfinished(self, sentence: str) -> bool:
        """Ask whether to use a capture that lacks some of its views."""
        choices = [
            _Choice(tr("Use what is there"), True, _ACCEPT),
            _Choice(tr("Go on capturing"), False, _REJECT),
        ]
        return self._choose(
            sentence,
            choices,
            default=False,
            details=tr("A foot that is not seen from all sides is cut, or too short."),
        )

    def make_alone(self, sentence: str, side: Side) -> bool:
        """Ask whether to make one foot of two, since the other one cannot be made."""
        make = {
            Side.LEFT: tr("Make the left foot alone"),
            Side.RIGHT: tr("Make the right foot alone"),
        }
        choices = [
            _Choice(make[side], True, _ACCEPT),
            _Choice(tr("Make no foot"), False, _REJECT),
        ]
        return self._choose(sentence, choices, default=False)

    def about_unsaved(self, name: str) -> Answer:
        """Ask what to do with unsaved work."""
        choices = [
            _Choice(tr("Save"), Answer.SAVE, _ACCEPT),
            _Choice(tr("Discard changes"), Answer.DISCARD, _DESTRUCT),
            _Choice(tr("Go on working"), Answer.CANCEL, _REJECT),
        ]
        sentence = tr("{name} has changes that are not saved.").format(name=name)
        return self._choose(sentence, choices, default=Answer.SAVE)

    def about_result(self, step: str) -> Answer:
        """Ask what to do with the result of a step of the calibration before it is left."""
        choices = [
            _Choice(tr("Save to the device"), Answer.SAVE, _ACCEPT),
            _Choice(tr("Drop the result"), Answer.DISCARD, _DESTRUCT),
            _Choice(tr("Go on working"), Answer.CANCEL, _REJECT),
        ]
        sentence = tr("The result of the step {step} is not saved.").format(step=step)
        return self._choose(sentence, choices, default=Answer.SAVE)

    def about_same_side(self, side: Side, order: str = "") -> SameSide:
        """Ask what to do with a second scan of the same foot.

        Parameters
        ----------
        order
            Number of the order that the case was exported as, which is not to be left by chance.
        """
        sentence = {
            Side.LEFT: tr("The case has a left foot already."),
            Side.RIGHT: tr("The case has a right foot already."),
        }
        choices = [
            _Choice(tr("Put in its place"), SameSide.REPLACE, _ACCEPT),
            _Choice(tr("Begin a new case"), SameSide.NEW_CASE, _ACT),
            _Choice(tr("Do not open"), SameSide.CANCEL, _REJECT),
        ]
        details = [tr("With the new scan in its place, the design can be repeated in one click.")]
        if order:
            details.insert(0, tr("The case was exported as order {number}.").format(number=order))
        return self._choose(
            sentence[side],
            choices,
            default=SameSide.CANCEL if order else SameSide.REPLACE,
            details=" ".join(details),
        )

    def about_case_in_use(self, sentence: str) -> InUse:
        """Ask how to open a case that another window has open."""
        choices = [
            _Choice(tr("Open read-only"), InUse.READ_ONLY, _ACCEPT),
            _Choice(tr("Open a copy"), InUse.COPY, _ACT),
            _Choice(tr("Do not open"), InUse.CANCEL, _REJECT),
        ]
        return self._choose(
            sentence,
            choices,
            default=InUse.READ_ONLY,
            details=tr(
                "Look at it without changing its file, or go on with a copy under another name."
            ),
        )

    def about_namesake(self, person: str, same: str, another: str) -> Namesake:
        """Ask whether a new patient is somebody whom the record has already.

        Parameters
        ----------
        person
            Who is there already, by all that tells namesakes apart.
        same, another
            What is done with the person who is there, and with another one: verbs for the buttons.
        """
        choices = [
            _Choice(same, Namesake.SAME, _ACCEPT),
            _Choice(another, Namesake.ANOTHER, _ACT),
            _Choice(tr("Add nobody"), Namesake.CANCEL, _REJECT),
        ]
        unbroken = person.replace("-", _UNBROKEN_HYPHEN)  # a pseudonym over two lines reads as two
        sentence = tr("The record has this name and birth date already: {person}.")
        return self._choose(
            sentence.format(person=unbroken),
            choices,
            default=Namesake.SAME,
            details=tr("Somebody who is there twice has only a part of the visits in each place."),
        )

    def about_failed_save(self, sentence: str) -> Unsaved:
        """Ask what to do with a case that could not be saved."""
        choices = [
            _Choice(tr("Save as…"), Unsaved.ELSEWHERE, _ACCEPT),
            _Choice(tr("Go on working"), Unsaved.GO_ON, _REJECT),
        ]
        return self._choose(
            sentence,
            choices,
            default=Unsaved.ELSEWHERE,
            details=tr("Nothing is lost: the case stays open, and is not saved yet."),
            icon=QMessageBox.Icon.Warning,
        )

    def about_changed_file(self, sentence: str) -> Unsaved:
        """Ask what to do with a case whose file another program has changed."""
        choices = [
            _Choice(tr("Save as…"), Unsaved.ELSEWHERE, _ACCEPT),
            _Choice(tr("Replace the file"), Unsaved.REPLACE, _DESTRUCT),
            _Choice(tr("Go on working"), Unsaved.GO_ON, _REJECT),
        ]
        return self._choose(
            sentence,
            choices,
            default=Unsaved.ELSEWHERE,
            details=tr("Saving here would discard what was changed there."),
            icon=QMessageBox.Icon.Warning,
        )

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
        choices = [
            _Choice(tr("Replace them"), True, _ACCEPT),
            _Choice(tr("Keep them"), False, _REJECT),
        ]
        sentence = tr("These files are there already: {names}").format(names=names)
        return self._choose(sentence, choices, default=False)

    def may_open_newer(self) -> bool:
        """Ask whether the version that was stored elsewhere takes the place of an older one."""
        choices = [
            _Choice(tr("Open the newer version"), True, _ACCEPT),
            _Choice(tr("Do not export"), False, _REJECT),
        ]
        sentence = tr(
            "This prescription was changed elsewhere, and a newer version is stored; what is shown "
            "here is not exported."
        )
        return self._choose(sentence, choices, default=True)

    def may_replace_own(self, name: str) -> bool:
        """Ask whether a device or form of the clinic may be replaced by one of the same name."""
        choices = [
            _Choice(tr("Replace it"), True, _DESTRUCT),
            _Choice(tr("Keep it"), False, _REJECT),
        ]
        sentence = tr("The clinic has “{name}” already.").format(name=name)
        return self._choose(sentence, choices, default=False)

    def may_discard(self, name: str) -> bool:
        """Ask whether recovered work may be discarded for good."""
        choices = [
            _Choice(tr("Discard it"), True, _DESTRUCT),
            _Choice(tr("Keep it"), False, _REJECT),
        ]
        sentence = tr("What was recovered of {name} and not saved will be gone for good.")
        return self._choose(sentence.format(name=name), choices, default=False)

    def may_lose_corrections(self, sentence: str) -> bool:
        """Ask whether a foot may lose corrections to a prescription that takes their place."""
        choices = [
            _Choice(tr("Replace the prescription"), True, _DESTRUCT),
            _Choice(tr("Keep the present one"), False, _REJECT),
        ]
        return self._choose(
            sentence, choices, default=False, details=tr("One step of undo brings them back.")
        )

    def may_delete_photo(self) -> bool:
        """Ask whether a photo may be deleted with what is drawn on it."""
        choices = [
            _Choice(tr("Delete the photo"), True, _DESTRUCT),
            _Choice(tr("Keep the photo"), False, _REJECT),
        ]
        sentence = tr("The photo and its marks will be gone for good.")
        return self._choose(sentence, choices, default=False)

    def may_remove_sample(self) -> bool:
        """Ask whether the sample patient may be removed with all that was tried on it."""
        choices = [
            _Choice(tr("Remove"), True, _DESTRUCT),
            _Choice(tr("Keep the sample patient"), False, _REJECT),
        ]
        sentence = tr(
            "The sample patient and everything that was tried on it will be removed. Help ▸ Sample "
            "patient brings a new one back."
        )
        return self._choose(sentence, choices, default=False)

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
            if not is_there(path) or self.may_replace([path]):
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

    def _choose(
        self,
        sentence: str,
        choices: Sequence[_Choice[Chosen]],
        *,
        default: Chosen,
        details: str = "",
        icon: QMessageBox.Icon = QMessageBox.Icon.NoIcon,
    ) -> Chosen:
        """Ask a question with a button for each answer, and return the chosen one.

        Parameters
        ----------
        sentence
            What there is to decide on.
        choices
            The last one is also that of Escape, and of a dialog that is closed without an answer.
        default
            Answer of the button that Enter presses.
        details
            What the answers lead to.
        """
        box = QMessageBox(self._parent)
        box.setWindowTitle(tr("Insole Studio"))
        box.setIcon(icon)
        said = translate_core_message(sentence)
        box.setText(with_capital(said))
        box.setInformativeText(details)
        answers: dict[QAbstractButton, Chosen] = {}
        for choice in choices:
            button = box.addButton(choice.verb, choice.role)
            answers[button] = choice.answer
            if choice.answer == default:
                box.setDefaultButton(button)
        box.exec()
        return answers.get(box.clickedButton(), choices[-1].answer)
