"""The scan of the last visit, offered to a visit that has none of its own."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from insole_core.cases.case_record import FootRecord
from insole_core.records.prescription import ScannedFoot
from insole_core.workflows.starting_design import starting_device
from insole_studio.features.records.same_prescription import SamePrescription
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_core.records.records import Records

NOTICE = "earlier-scan"
_CHANNEL = "records-earlier-scan"


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
        self._services.notices.put(NOTICE, sentence, (verb, lambda: self.take(found)))

    def take(self, found: Sequence[ScannedFoot]) -> None:
        """Begin a prescription on earlier scans; the day stands on screen, papers and record."""
        visit_id = self._services.keeper.visit_id
        starting = starting_device(self._services.paths.settings_folder)
        if starting.problem is not None:
            self._services.messages.show_sentence(starting.problem)

        def read(records: Records) -> list[FootRecord]:
            from insole_core.workflows.earlier_scan import on_earlier_scan

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
            self._services.notices.drop(NOTICE)
