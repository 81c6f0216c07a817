"""Presenter of the person page: edits are stored at once and can be undone."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from datetime import date
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from insole_core.errors import Conflict, InputError, InsoleError
from insole_core.geometry.side import Side
from insole_core.history import History
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.records.capture import Capture
from insole_core.records.order import OrderSummary
from insole_core.records.person import Person
from insole_core.records.prescription import VersionSummary
from insole_core.records.record_field import (
    FieldChoice,
    changed_fields,
    merge_fields,
    settle_fields,
)
from insole_core.records.visit import CaptureState, Visit
from insole_core.records.visit_measures import stored_measures
from insole_core.workflows.starting_design import starting_device
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.features.records.person_page import PERSON, PersonPage
from insole_studio.features.records.record_form import label_of, shown_texts
from insole_studio.features.records.rows import (
    FootLine,
    Trend,
    VisitRow,
    capture_text,
    mirrored_text,
    order_text,
    prescribed_text,
    reused_scan_text,
    scan_text,
    version_text,
    visit_heading,
    visit_texts,
)
from insole_studio.features.records.version_dialogs import AskFields, collided_fields
from insole_studio.features.records.visit_card import VisitPictures
from insole_studio.services.person_list import visit_time_text
from insole_studio.texts import tr, translate_core_message

if TYPE_CHECKING:
    from insole_core.records.prescriptions import NewestVersion
    from insole_core.records.records import Records

READ = "records-person"
log = logging.getLogger(__name__)

"""Characters of the findings that a card shows."""
_MOST_SCANS = 3
"""Captures that a card tells of, the latest."""
_MOST_PICTURED = 12
"""Visits with pictures: further ones are old, and far down."""

_Told = TypeVar("_Told")


@dataclass(frozen=True)
class VisitView:
    """A visit with the newest version of each foot, captures, orders, and who else has it open."""

    visit: Visit
    newest: tuple[VersionSummary, ...]
    captures: tuple[Capture, ...]
    reused_scans: Sequence[str]
    """Of which days those scans are that an earlier visit had already."""
    scanned_feet: Sequence[tuple[str, Side]]
    """Each with the SHA-256 of its scan."""
    mirrored_feet: Sequence[Side]
    """Those that were not scanned."""
    others: tuple[str, ...]
    designs: Mapping[str, InsoleDesign]
    """What versions prescribe, by their ids."""
    orders: tuple[OrderSummary, ...]
    photos: int = 0


@dataclass(frozen=True)
class PersonView:
    """A person with what the page shows of them, the newest visit first.

    Parameters
    ----------
    is_prescribed
        Whether a new visit can take a prescription from one of these.
    """

    person: Person
    visits: tuple[VisitView, ...]
    is_prescribed: bool


class PersonPresenter:
    """Shows one person of the record, and stores what is edited.

    Parameters
    ----------
    tell
        Shows an error that belongs to no field.
    ask
        Asks which values of fields count that somebody else has changed, too.
    settings
        Folder with the device that new designs begin with.
    """

    def __init__(
        self,
        page: PersonPage,
        clinic: ClinicRecord,
        tell: Callable[[Exception], None],
        ask: AskFields,
        settings: Path,
    ) -> None:
        self._page = page
        self._clinic = clinic
        self._tell = tell
        self._ask = ask
        self._settings = settings
        self._person: Person | None = None
        self._wanted: Person | None = None
        """The person as they should be stored, while an earlier change is being stored."""
        self._is_storing = False
        self._history: History[Person] = History()
        self.visits: tuple[VisitView, ...] = ()
        self._is_prescribed = False
        self._pictures = VisitPictures(clinic, page.show_picture)
        page.field_edited.connect(self.edit_field)
        clinic.changed.connect(self.refresh)
        clinic.author_changed.connect(self._note_seen)
        clinic.state_changed.connect(self._show_state)

    @property
    def person(self) -> Person | None:
        """The person on the page, with what is being stored."""
        return self._wanted or self._person

    @property
    def why_not_same(self) -> str:
        """Why no new visit of the person can take the last prescription; empty where one can."""
        if why_not := self._clinic.why_not_change:
            return why_not
        return "" if self._is_prescribed else tr("Nothing was prescribed on an earlier visit.")

    def open(self, person_id: str) -> None:
        """Show a person; the audit log tells that somebody looked."""
        if self._person is None or self._person.id != person_id:
            self._page.forget_typed()
            self._history.clear()
            self._person = self._wanted = None
            self._is_prescribed = False
        self._clinic.ask(
            READ,
            lambda r: _read(r, person_id, self._settings, seen=True),
            self._take,
            self._tell,
        )

    def refresh(self) -> None:
        """Show what has changed in the record."""
        person = self._person
        if person is not None and self._clinic.is_open and self._page.isVisible():
            self._clinic.ask(
                READ, lambda r: _read(r, person.id, self._settings), self._take, self._tell
            )

    def _note_seen(self) -> None:
        """Let the audit log tell that whoever has signed in sees the page that was open."""
        person = self._person
        if person is not None and self._page.isVisible() and self._clinic.may_show_patients:
            self._clinic.write(
                lambda records: records.persons.open(person.id), lambda _person: None, self._tell
            )

    def edit_field(self, key: str, text: str) -> None:
        """Set a field; what cannot be right is refused, and the old value stays."""
        person = self.person
        if person is None:
            return
        try:
            after = person.with_typed(key, text, date.today())
        except InputError as error:
            self._page.show_refusal(key, translate_core_message(error.message))
            self._show_fields()
            return
        if after != person:
            self._history.push(person, after, tr("Edit the patient's fields"))
            self._store(after)
        self._show_fields()

    def visit_of(self, visit_id: str) -> VisitView | None:
        """Return a visit of the person on the page; None if it is none of theirs."""
        return next((shown for shown in self.visits if shown.visit.id == visit_id), None)

    @property
    def undo_sentence(self) -> str:
        """The edit that the next undo reverts; empty when there is none."""
        return self._history.undo_sentence

    @property
    def redo_sentence(self) -> str:
        """The edit that the next redo repeats; empty when there is none."""
        return self._history.redo_sentence

    def undo(self) -> None:
        """Undo the last edit of a field."""
        self._step_to(self._history.undo())

    def redo(self) -> None:
        """Redo the edit undone last."""
        self._step_to(self._history.redo())

    def _step_to(self, person: Person | None) -> None:
        if person is not None:
            self._store(person)
            self._show_fields()

    def _store(self, person: Person) -> None:
        """Store a person after what is being stored; of several wishes only the last one counts."""
        self._wanted = person
        if self._is_storing or self._person is None:
            return
        self._is_storing = True
        revision = self._person.revision
        self._clinic.write(
            lambda records: records.persons.change(person, revision), self._stored, self._failed
        )

    def _stored(self, person: Person) -> None:
        self._is_storing = False
        if self._person is None or self._person.id != person.id:
            return
        wanted, self._wanted, self._person = self._wanted, None, person
        if wanted is not None and changed_fields(person, wanted):
            self._store(wanted)
        self._show_fields()

    def _failed(self, error: Exception) -> None:
        self._is_storing = False
        wanted, self._wanted = self._wanted, None
        if isinstance(error, Conflict) and wanted is not None and self._person is not None:
            self._store_over(wanted, error.theirs)
            return
        self._show_fields()
        self._tell(error)

    def _store_over(self, wanted: Person, theirs: Person) -> None:
        """Store the fields that were changed here alone; ask about those changed by both."""
        assert self._person is not None
        merged, collided = merge_fields(self._person, wanted, theirs, tuple(PERSON))
        self._person = theirs
        self._store(merged)
        self._show_fields()
        if collided:
            asked = collided_fields(wanted, theirs, collided, PERSON)
            self._ask(asked, partial(self._settle, wanted))

    def _settle(self, mine: Person, choices: Mapping[str, FieldChoice]) -> None:
        """Store what was chosen; undo brings back what was typed here."""
        person = self.person
        if person is None or person.id != mine.id:
            return
        after = settle_fields(person, mine, choices)
        typed = settle_fields(person, mine, dict.fromkeys(choices, FieldChoice.MINE))
        if after != typed:
            self._history.push(typed, after, tr("Edit the patient's fields"))
        if after != person:
            self._store(after)
        self._show_fields()

    def _take(self, view: PersonView) -> None:
        if self._person is not None and self._person.id != view.person.id:
            self._history.clear()
        if view.person.is_erased:  # what was typed before must not come back on the screen
            self._page.forget_typed()
            self._history.clear()
        if not self._is_storing:
            self._person = view.person
        self.visits, self._is_prescribed = view.visits, view.is_prescribed
        self._show_fields()
        self._show_state()
        self._page.show_visits([_row(visit) for visit in view.visits])
        self._page.show_trends(trends_of([shown.visit for shown in view.visits]))
        pictured = view.visits[:_MOST_PICTURED]
        self._pictures.want([version for shown in pictured for version in shown.newest])

    def _show_state(self) -> None:
        self._page.show_why_not_change(self._clinic.why_not_change)
        self._page.show_why_not_same(self.why_not_same)

    def _show_fields(self) -> None:
        if (person := self.person) is not None:
            self._page.show_sample(person.is_sample)
            self._page.show_person(shown_texts(person))


def _read(records: Records, person_id: str, settings: Path, *, seen: bool = False) -> PersonView:
    person = records.persons.open(person_id) if seen else records.persons.get(person_id)
    with records.snapshot():
        visits = records.visits.of_person(person.id)
        orders = records.orders.of_person(person.id)
        photos = records.photos.counts_of([visit.id for visit in visits])
        newest = [records.prescriptions.newest(visit.id) for visit in visits]
        views = tuple(
            _visit_view(records, visit, versions, orders, photos)
            for visit, versions in zip(visits, newest, strict=True)
        )
    return PersonView(person, views, _is_prescribed(newest, settings))


def _is_prescribed(newest: Sequence[Sequence[NewestVersion]], settings: Path) -> bool:
    """Return whether one of the versions can be taken over, or is damaged.

    Of a damaged one whoever takes it over is told.
    """
    if not any(newest):
        return False
    starting = starting_device(settings)
    try:
        return any(one.prescribes(starting.prescribes) for found in newest for one in found)
    except InsoleError:
        return True


def _visit_view(
    records: Records,
    visit: Visit,
    newest: Sequence[NewestVersion],
    orders: Sequence[OrderSummary],
    photos: Mapping[str, int],
) -> VisitView:
    others = records.presence.others(visit.id)
    return VisitView(
        visit,
        tuple(version.summary for version in newest),
        tuple(records.captures.of_visit(visit.id)),
        _of_versions(visit, lambda: [v.source.scanned_on for v in newest if v.source.scanned_on]),
        _of_versions(
            visit,
            lambda: [(v.source.sha256, v.summary.side) for v in newest if not v.source.mirrored],
        ),
        _of_versions(visit, lambda: [v.summary.side for v in newest if v.source.mirrored]),
        tuple(f"{present.author}, {present.station}" for present in others),
        dict(_of_versions(visit, lambda: [(v.summary.id, v.design) for v in newest])),
        tuple(order for order in orders if order.visit_id == visit.id),
        photos.get(visit.id, 0),
    )


def _of_versions(visit: Visit, told: Callable[[], list[_Told]]) -> list[_Told]:
    """Return what the versions of a visit tell; a damaged one costs its card these words only."""
    try:
        return told()
    except InsoleError as error:
        log.warning("a version of visit %s cannot be read: %s", visit.id, error)
        return []


def _row(shown: VisitView) -> VisitRow:
    visit = shown.visit
    notes = []
    if visit.capture_state is CaptureState.WANTED:
        state = capture_text(visit.capture_state)
        notes.append(tr("Capture: {state}").format(state=state))
    if shown.others:
        notes.append(tr("Open at the moment: {who}").format(who="; ".join(shown.others)))
    notes += visit_texts(visit)
    notes += [order_text(order, date.today()) for order in shown.orders]
    feet = tuple(
        FootLine(
            version.side,
            prescribed_text(shown.designs.get(version.id)),
            _version_line(version),
            version.signed_by is not None,
        )
        for version in shown.newest
    )
    return VisitRow(
        visit.id,
        visit_time_text(visit),
        visit_heading(visit),
        feet,
        tuple(notes),
        shown.photos,
        (
            *(scan_text(one, _sides_of(shown, one)) for one in shown.captures[:_MOST_SCANS]),
            *(reused_scan_text(day) for day in sorted(set(shown.reused_scans))),
            *map(mirrored_text, shown.mirrored_feet),
        ),
        tuple(
            translate_core_message(line)
            for capture in shown.captures[:_MOST_SCANS]
            for line in capture.facts.residual_lines
        ),
    )


def _sides_of(shown: VisitView, capture: Capture) -> list[Side]:
    """Return of which feet a capture is; a copy from the record is known by its content."""
    digests = capture.source_sha256, capture.content_sha256
    return [side for digest, side in shown.scanned_feet if digest in digests]


def _version_line(version: VersionSummary) -> str:
    number = tr("Version {number}").format(number=version.number)
    return f"{number}: {version_text(version)}"


def trends_of(visits: Sequence[Visit]) -> list[Trend]:
    """Return each measure that two or more visits have, over their days, oldest first."""
    found: dict[tuple[str, Side | None], list[tuple[str, float, float | None]]] = {}
    for visit in sorted(visits, key=lambda visit: (visit.visited_on, visit.created_at)):
        day = visit.visited_on.isoformat()
        for one in stored_measures(visit.measures):
            name = _names().get(one.key)
            if name is not None:
                point = (day, one.value, one.spread.limits_95)
                found.setdefault((name, one.side), []).append(point)
        if visit.weight_kg is not None:
            weight = (label_of(Visit, "weight_kg"), None)
            found.setdefault(weight, []).append((day, visit.weight_kg, None))
    return [
        Trend(name, days, values, side, limits)
        for (name, side), points in found.items()
        if len(points) > 1
        for days, values, limits in [tuple(zip(*points, strict=True))]
    ]


def _names() -> dict[str, str]:
    return {
        "foot_length_mm": tr("Foot length (mm)"),
        "ball_width_mm": tr("Ball width (mm)"),
        "heel_width_mm": tr("Heel width (mm)"),
        "arch_height_mm": tr("Arch height (mm)"),
        "navicular_height_mm": tr("Navicular height (mm)"),
    }
