"""What the Prescribe menu does beyond single corrections: templates, repetition, landmarks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from PySide6.QtGui import QGuiApplication

from insole_core.cases.case_file import read_case
from insole_core.errors import InputError
from insole_core.export.atomic import replacing_file
from insole_core.insole.corrections import CorrectionBase
from insole_core.insole.design import Correction, InsoleDesign
from insole_core.insole.template import (
    Template,
    apply_template,
    make_template,
    read_template,
    write_template,
)
from insole_studio.shell.dialogue import Dialogue
from insole_studio.shell.file_kinds import TEMPLATE_SUFFIX, case_kinds, template_kinds
from insole_studio.stages.design.measure_texts import as_csv, measures_of
from insole_studio.texts import tr
from insole_studio.tools.correction_names import name_of
from insole_studio.tools.hand import Hand
from insole_studio.tools.pelott import PelottTool
from insole_studio.workbench.case import Case
from insole_studio.workbench.landmarks import confirmed, found_anew, landmarks_of
from insole_studio.workbench.pad_library import LibraryPad


class Prescribing:
    """The actions of the Prescribe menu."""

    def __init__(
        self, case: Case, hand: Hand, pads: Sequence[LibraryPad], dialogue: Dialogue
    ) -> None:
        self._case = case
        self._hand = hand
        self._pads = pads
        self._dialogue = dialogue

    def prescribe(self, correction: Correction) -> None:
        """Add a correction and show its values."""
        design = self._case.record.design
        if design is None:
            return
        new = self._case.stamped(correction)
        self._case.apply(design.with_added(new), tr("Add: {name}").format(name=name_of(new)))
        self._case.select(new.id)

    def take_pad(self, number: int) -> None:
        """Take the pad tool with a pad of the library."""
        tool = self._hand.tools["pelott"]
        assert isinstance(tool, PelottTool)
        tool.template = self._pads[number].template
        self._case.select(None)
        self._hand.take("pelott")

    def ask_save_template(self) -> None:
        """Let the user choose where the template goes."""
        path = self._dialogue.questions.file_to_write(
            f"template{TEMPLATE_SUFFIX}", template_kinds()
        )
        if path is not None and self._case.record.design is not None:
            save_template(self._case, path.with_suffix(TEMPLATE_SUFFIX))
            self._dialogue.say(tr("Written: {name}").format(name=path.name))

    def ask_apply_template(self) -> None:
        """Let the user choose a template."""
        path = self._dialogue.questions.file_to_open(template_kinds())
        if path is not None and self._case.record.design is not None:
            self._case.apply(template_for(self._case, path), tr("Apply a template"))

    def ask_repeat_design(self) -> None:
        """Let the user choose an earlier case."""
        path = self._dialogue.questions.file_to_open(case_kinds())
        if path is not None and self._case.record.design is not None:
            design = design_of_case(self._case, path)
            self._case.apply(design, tr("Repeat the design of an earlier case"))

    def copy_measures(self) -> None:
        """Put the table of measures onto the clipboard."""
        QGuiApplication.clipboard().setText(self._measures_csv())

    def ask_save_measures(self) -> None:
        """Let the user choose where the table of measures goes."""
        path = self._dialogue.questions.file_to_write("measures.csv", "CSV (*.csv)")
        if path is not None:
            with replacing_file(path.with_suffix(".csv")) as beside:
                beside.write_text(self._measures_csv(), encoding="utf-8")
            self._dialogue.say(tr("Written: {name}").format(name=path.name))

    def _measures_csv(self) -> str:
        record = self._case.record
        return as_csv(measures_of(record), str(record.side))

    def confirm_landmarks(self) -> None:
        """Take all landmarks as they are shown."""
        self._case.apply(confirmed(self._case.record), tr("Confirm the landmarks"))

    def find_landmarks(self) -> None:
        """Forget the landmarks that were set by hand."""
        anew = found_anew(self._case.record.annotations)
        self._case.apply(anew, tr("Find the landmarks anew"))


def save_template(case: Case, path: Path) -> None:
    """Write the prescription with the places of the landmarks that it fits.

    Raises
    ------
    DesignError, OutputError
    """
    design = case.record.design
    assert design is not None
    plain = tuple(replace(c, author="", created_at="") for c in design.corrections)
    anonymous = replace(design, corrections=plain)
    template = make_template(path.stem, anonymous, landmarks_of(case.record))
    with replacing_file(path) as beside:
        write_template(template, beside)


def template_for(case: Case, path: Path) -> InsoleDesign:
    """Read a template for the open foot: mirrored where it is of the other side.

    Raises
    ------
    InputError, DesignError
        When it is no template, one of a newer version, or the landmarks fit no foot.
    """
    return _fitted(case, read_template(path))


def design_of_case(case: Case, path: Path) -> InsoleDesign:
    """Read the prescription of another case for the open foot.

    Raises
    ------
    InputError, DesignError
        When the file is no case, or holds no prescription.
    """
    earlier = read_case(path)
    if earlier.design is None:
        raise InputError(f"{path} holds no prescription yet; choose a case with a design.")
    return _fitted(case, make_template("", earlier.design, landmarks_of(earlier)))


def _fitted(case: Case, template: Template) -> InsoleDesign:
    """Bring a prescription to the open foot; it is prescribed anew."""
    assert case.side is not None
    design = apply_template(template, case.side, landmarks_of(case.record))
    fresh = (case.stamped(replace(c, id=CorrectionBase().id)) for c in design.corrections)
    return replace(design, corrections=tuple(fresh))
