"""The two feet of a case: choosing the active one, and copying between them."""

from __future__ import annotations

from dataclasses import replace

from insole_core.cases.case_record import FootRecord
from insole_core.errors import UsageError
from insole_core.geometry.side import Side
from insole_core.insole.elements import Correction
from insole_core.workflows.starting_design import fitted, mirrored_foot, template_of
from insole_studio.document.case import Case
from insole_studio.features.design.actions.lost_corrections import may_replace
from insole_studio.features.design.correction_names import name_of
from insole_studio.services.user_messages import UserMessages
from insole_studio.texts import tr


class FeetActions:
    """The actions of the Feet menu."""

    def __init__(self, case: Case, messages: UserMessages) -> None:
        self._case = case
        self._messages = messages

    def take(self, side: Side) -> None:
        """Make the foot of a side the active one.

        Raises
        ------
        UsageError
            If the case has no such foot.
        """
        if self._case.record.of_side(side) is None:
            raise UsageError(_missing(side))
        self._case.take_foot(side)

    def take_other(self) -> None:
        """Make the other foot the active one.

        Raises
        ------
        UsageError
            If the case has no other foot.
        """
        side = self._case.side
        if side is not None:
            self.take(side.other)

    def mirror(self) -> None:
        """Make the foot that was not scanned, and its prescription, as a mirror image.

        Raises
        ------
        UsageError
            If the case has both feet.
        DesignError
            If landmarks lie in an impossible order.
        """
        foot = self._case.record.current
        assert foot is not None, "the action needs a foot"
        if self._case.record.other is not None:
            raise UsageError(_there(foot.side.other))
        sentence = {
            Side.LEFT: tr("Mirror the right foot to the left"),
            Side.RIGHT: tr("Mirror the left foot to the right"),
        }
        self._case.apply(mirrored_foot(foot, self._case.stamped), sentence[foot.side.other])

    def copy_prescription(self) -> None:
        """Copy the prescription to the other foot, mirrored; ask where that costs corrections.

        Raises
        ------
        UsageError
            If the case has no other foot.
        DesignError
            If landmarks lie in an impossible order.
        """
        foot, other = self._both()
        design = fitted(template_of(foot), other, self._case.stamped)
        sentence = {
            Side.LEFT: tr("Copy the prescription to the left foot"),
            Side.RIGHT: tr("Copy the prescription to the right foot"),
        }
        if may_replace(self._messages.questions, other.design, design):
            self._case.apply(other.with_design(design), sentence[other.side])

    def copy_selected(self) -> None:
        """Copy the selected correction to the other foot, mirrored.

        Raises
        ------
        UsageError
            If the case has no other foot, or no correction is selected.
        DesignError
            If landmarks lie in an impossible order.
        """
        foot, other = self._both()
        selected = self._selected(foot)
        alone = foot.with_design(replace(foot.design, corrections=(selected,)))
        (mirrored,) = fitted(template_of(alone), other, self._case.stamped).corrections
        sentence = {
            Side.LEFT: tr("Copy to the left foot: {name}"),
            Side.RIGHT: tr("Copy to the right foot: {name}"),
        }
        added = other.with_design(other.design.with_added(mirrored))
        self._case.apply(added, sentence[other.side].format(name=name_of(mirrored)))
        self._case.select(mirrored.id)

    def _both(self) -> tuple[FootRecord, FootRecord]:
        foot, other = self._case.record.current, self._case.record.other
        assert foot is not None, "the action needs a foot"
        if other is None:
            raise UsageError(_missing(foot.side.other))
        return foot, other

    def _selected(self, foot: FootRecord) -> Correction:
        selected = foot.design.correction(self._case.selection or "")
        if selected is None:
            raise UsageError(tr("No correction is selected; click on one in the list first."))
        return selected


def _there(side: Side) -> str:
    if side is Side.LEFT:
        return tr("The case has a left foot already; only one that was not scanned is mirrored.")
    return tr("The case has a right foot already; only one that was not scanned is mirrored.")


def _missing(side: Side) -> str:
    if side is Side.LEFT:
        return tr("The case has no left foot yet; open its scan, and it is added.")
    return tr("The case has no right foot yet; open its scan, and it is added.")
