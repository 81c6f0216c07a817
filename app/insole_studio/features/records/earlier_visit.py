"""What a new visit takes from the last one: its prescription, its scan."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from insole_core.cases.case_record import FootRecord
from insole_core.errors import InsoleError
from insole_core.geometry.side import Side
from insole_core.insole.prescription.template import Template
from insole_core.records.prescription import ScannedFoot
from insole_core.workflows.starting_design import (
    StartingDevice,
    fitted,
    last_design,
    on_earlier_scan,
    starting_device,
)
from insole_studio.features.records.rows import prescribed_text
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_core.records.records import Records

_PRESCRIPTION_NOTICE = "same-prescription"

_SCAN_NOTICE = "earlier-scan"
_CHANNEL = "records-earlier-scan"


@dataclass(frozen=True)
class _Coming:
    """What a visit begins with: for each foot, the last prescription."""

    visit_id: str
    templates: Mapping[Side, Template]
    applied: bool


class SamePrescription(QObject):
    """Gives each new scan of a new visit the prescription of the last one.

    It is fitted by the landmarks as one step of undo, or only offered ("Repeat the last design").
    """

    def __init__(self, services: AppServices) -> None:
        super().__init__(services.window)
        self._services = services
        self._case = services.case
        self._coming: _Coming | None = None
        self._case.foot_changed.connect(self._begin_foot)
        self._case.opened.connect(self._tell)
        services.keeper.moved.connect(self._move)

    def expect(self, visit_id: str, templates: Mapping[Side, Template], *, applied: bool) -> None:
        """Expect the scans of a visit.

        Parameters
        ----------
        applied
            Whether a new scan gets its prescription at once; otherwise it is offered.
        """
        self._coming = _Coming(visit_id, templates, applied)

    def _move(self, before: str, visit_id: str) -> None:
        """Expect of the visit that has taken the place of a lost one what was expected of that."""
        if self._coming is not None and self._coming.visit_id == before:
            self._coming = replace(self._coming, visit_id=visit_id)

    def prescribed(self, foot: FootRecord) -> FootRecord:
        """Return a foot with the prescription that its visit expects, if it is to get one."""
        coming = self._of_visit
        template = None if coming is None else coming.templates.get(foot.side)
        if coming is None or template is None or not coming.applied:
            return foot
        try:
            return foot.with_design(fitted(template, foot, self._case.stamped))
        except InsoleError as error:
            self._services.messages.show_error(error)
            return foot

    @property
    def _of_visit(self) -> _Coming | None:
        """What the open visit begins with; None for one that nothing is expected of."""
        coming = self._coming
        is_open = coming is not None and self._services.keeper.visit_id == coming.visit_id
        return coming if is_open else None

    def _tell(self) -> None:
        """Say what the scans of the visit will be prescribed, while it has none."""
        coming = self._of_visit
        if coming is None or not coming.applied or self._case.record.feet:
            return
        side = {Side.LEFT: tr("left: {words}"), Side.RIGHT: tr("right: {words}")}
        feet = [
            side[foot].format(words=prescribed_text(coming.templates[foot].design))
            for foot in Side
            if foot in coming.templates
        ]
        sentence = (
            tr("A scan of this visit is prescribed as last time: {feet}. Capture or import it.")
            if feet
            else tr("Nothing was prescribed for this patient before; a scan begins anew.")
        )
        self._services.notices.put(_PRESCRIPTION_NOTICE, sentence.format(feet=";  ".join(feet)))

    def _begin_foot(self) -> None:
        coming, foot = self._of_visit, self._case.record.current
        if coming is None or foot is None:
            return
        self._services.notices.drop(_PRESCRIPTION_NOTICE)
        template = coming.templates.get(foot.side)
        if template is None or foot.earlier is not None or foot.design.corrections:
            return
        step = (
            tr("Prescribe as on the last visit")
            if coming.applied
            else tr("Remember the last prescription")
        )
        self._case.apply(self.prescribed(replace(foot, earlier=template)), step)


def last_prescriptions(
    records: Records, person_id: str, starting: StartingDevice
) -> dict[Side, Template]:
    """Return the last prescription of each foot of a person, on whichever visit it was."""
    feet = records.prescriptions.last_prescribed(person_id, starting.prescribes)
    templates = {foot.side: last_design(foot, starting) for foot in feet}
    return {side: template for side, template in templates.items() if template is not None}


class EarlierScan(QObject):
    """Offers the last scan to each visit without one, and takes it as one step of undo."""

    def __init__(self, services: AppServices, same_prescription: SamePrescription) -> None:
        super().__init__(services.window)
        self._services = services
        self._case = services.case
        self._same_prescription = same_prescription
        self._case.opened.connect(self._look)
        self._case.foot_changed.connect(self._note_foot)

    @property
    def _has_no_scan(self) -> bool:
        return self._case.kept is not None and not self._case.record.feet

    def _look(self) -> None:
        """Ask for the last scans of the patient whose visit has none."""
        kept, clinic = self._case.kept, self._services.clinic
        if kept is None or not self._has_no_scan or not clinic.is_open:
            return
        person_id, visit_id = kept.person.id, kept.visit.id

        def offer(found: list[ScannedFoot]) -> None:
            if found and self._has_no_scan and self._services.keeper.visit_id == visit_id:
                self._offer(found)

        # Whatever goes wrong, the scan can still be made anew.
        clinic.ask(
            _CHANNEL, lambda r: r.prescriptions.last_scanned(person_id), offer, lambda _error: None
        )

    def _offer(self, found: Sequence[ScannedFoot]) -> None:
        day = max(scan.scanned_on for scan in found).isoformat()
        sentence = tr("This visit has no scan yet; the last one is of {day}.").format(day=day)
        verb = tr("Use the scan of {day}").format(day=day)
        self._services.notices.put(_SCAN_NOTICE, sentence, (verb, lambda: self.take(found)))

    def take(self, found: Sequence[ScannedFoot]) -> None:
        """Begin a prescription on earlier scans; the day stands on screen, papers and record."""
        visit_id = self._services.keeper.visit_id
        starting = starting_device(self._services.paths.settings_folder)
        if starting.problem is not None:
            self._services.messages.show_sentence(starting.problem)

        def read(records: Records) -> list[FootRecord]:
            return [
                on_earlier_scan(
                    records.prescriptions.read(scan.version_id), scan.scanned_on, starting
                )
                for scan in found
            ]

        def begin(feet: list[FootRecord]) -> None:
            if self._services.keeper.visit_id != visit_id or not self._has_no_scan:
                return
            record = self._case.record
            for foot in reversed(feet):  # the left foot is shown first
                record = record.with_foot(self._same_prescription.prescribed(foot))
            self._case.apply(record, tr("Use the earlier scan"))

        self._services.clinic.ask(_CHANNEL, read, begin, self._services.messages.show_error)

    def _note_foot(self) -> None:
        if self._case.record.feet:
            self._services.notices.drop(_SCAN_NOTICE)
