"""Offer to repeat an earlier prescription: that of the last scan, or that of the other foot."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject

from insole_core.cases.case_record import FootRecord
from insole_core.errors import DesignError, InsoleError
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.prescription.template import Template
from insole_core.progress import Progress
from insole_core.workflows.starting_design import (
    find_last_design,
    fitted,
    identity,
    prescribed_at,
    starting_device,
)
from insole_studio.features.design.actions.feet_actions import FeetActions
from insole_studio.features.design.actions.variant_actions import may_replace
from insole_studio.features.design.correction_names import name_of
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr, translate_core_message

CHANNEL = "earlier"
NOTICE, MIRROR = "repeat", "mirror"


class RepeatActions(QObject):
    """Finds the last design of the active foot while nothing is prescribed for it."""

    def __init__(self, services: AppServices, feet: FeetActions) -> None:
        super().__init__(services.window)
        self._services = services
        self._case = case = services.case
        self._messages = services.messages
        self._notices = services.notices
        self._recent = services.recent
        self._feet = feet
        self._mirror_offered: Foot | None = None
        self._found: dict[tuple[object, Side], Template | None] = {}
        self._offered: tuple[Foot, Template] | None = None
        case.foot_changed.connect(self.offer)
        case.changed.connect(self.offer)

    @property
    def last_design(self) -> Template | None:
        """The last prescription of the active foot before its present design."""
        foot = self._case.record.current
        if foot is None:
            return None
        return foot.earlier or self._found.get((identity(self._case.record.patient), foot.side))

    def offer(self) -> None:
        """Offer the last design for a foot without one."""
        foot = self._case.record.current
        if foot is None or foot.design.corrections:
            self._withdraw()
            return
        template = self.last_design
        if template is None:
            self._withdraw()
            self._offer_mirror(foot)
            self._search(foot.side)
        elif self._offered != (foot.foot, template):  # once: it may be dismissed
            self._offered = foot.foot, template
            if not self._is_prescribed(template, foot):
                self._notices.put(
                    NOTICE, _describe(template), (tr("Repeat the last design"), self.repeat)
                )

    def repeat(self) -> None:
        """Apply the prescription of the last scan to this one."""
        foot, template = self._case.record.current, self.last_design
        if foot is None or template is None:
            self._messages.show_sentence(
                tr("No earlier design of this patient is known; open the earlier case once.")
            )
            return
        try:
            design = fitted(template, foot, self._case.stamped)
        except InsoleError as error:
            self._messages.show_error(error)
            return
        if may_replace(self._messages.questions, foot.design, design):
            self._case.apply(design, tr("Repeat the last design"))
            self._notices.drop(NOTICE)  # also of one that holds no corrections

    def _is_prescribed(self, template: Template, foot: FootRecord) -> bool:
        """Return whether a prescription that has no corrections is that of a foot already."""
        if template.design.corrections:
            return False
        try:
            return fitted(template, foot, self._case.stamped) == foot.design
        except DesignError:  # landmarks in an impossible order, which are told where it is repeated
            return False

    def _offer_mirror(self, foot: FootRecord) -> None:
        """Offer the mirrored prescription of the other foot, once per foot without one."""
        other = self._case.record.other
        if other is None or not other.design.corrections or foot.foot is self._mirror_offered:
            return
        self._mirror_offered = foot.foot
        text = {
            Side.LEFT: tr("The right foot has a prescription."),
            Side.RIGHT: tr("The left foot has a prescription."),
        }
        self._notices.put(
            MIRROR, text[foot.side], (tr("Prescribe it here, mirrored"), self._mirror)
        )

    def _mirror(self) -> None:
        self._feet.take_other()
        self._feet.copy_prescription()

    def forget(self) -> None:
        """Let go of the feet of a case that is closed, and of what was found for them."""
        self._services.jobs.cancel(CHANNEL)
        self._found.clear()
        self._offered = self._mirror_offered = None
        for notice in (NOTICE, MIRROR):
            self._notices.drop(notice)

    def _withdraw(self) -> None:
        self._offered = None
        self._notices.drop(NOTICE)
        if self._case.foot is not self._mirror_offered or self._has_corrections:
            self._mirror_offered = None
            self._notices.drop(MIRROR)

    @property
    def _has_corrections(self) -> bool:
        foot = self._case.record.current
        return foot is not None and bool(foot.design.corrections)

    def _search(self, side: Side) -> None:
        patient = self._case.record.patient
        key = identity(patient), side
        if key[0] is None or key in self._found:
            return
        self._found[key] = None
        paths = [Path(name) for name in self._recent.names if Path(name) != self._case.path]

        def search(progress: Progress) -> Template | None:
            starting = starting_device(self._services.paths.settings_folder)
            return find_last_design(paths, patient, side, starting, progress)

        def found(template: Template | None) -> None:
            self._found[key] = template
            if template is not None:
                self.offer()

        self._services.run(CHANNEL, search, found)


def _describe(template: Template) -> str:
    of_corrections = dict.fromkeys(name_of(c) for c in template.design.corrections)
    device = translate_core_message(template.design.device)
    names = ", ".join(of_corrections) or device or tr("no corrections")
    day = prescribed_at(template.design)[:10]
    if not day:
        return tr("Prescribed for this foot before: {names}.").format(names=names)
    return tr("Prescribed for this foot on {day}: {names}.").format(day=day, names=names)
