"""The captures of the open visit: scans made here are stored, those of others are offered."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal

from insole_core.cases.scan_source import ScanSource
from insole_core.geometry.side import Side
from insole_core.records.capture import Capture
from insole_studio.services.app_services import AppServices
from insole_studio.texts import moment_text, tr

if TYPE_CHECKING:
    from insole_core.records.records import Records

CHANNEL = "records-captures"
NOTICE = "record-capture"


class VisitCaptures(QObject):
    """Stores the scan of each foot with its visit, and offers captures of the capture room."""

    fetched = Signal(object)
    """The path of a capture that was copied out of the record, to be opened."""

    def __init__(self, services: AppServices) -> None:
        super().__init__(services.window)
        self._services = services
        self._case = services.case
        self._clinic = services.clinic
        self._visit_id = ""
        self._stored: dict[str, Side | None] | None = None
        """SHA-256 of the scans that the visit has, each with the side that it was taken as by hand;
        None before the first answer."""
        self._refused: dict[Path, str] = {}
        """What the record did not take for the open visit, each with its kind."""
        self._case.opened.connect(self._begin)
        services.keeper.moved.connect(self._move)
        self._case.changed.connect(self._store_new)
        self._clinic.changed.connect(self._look)

    def store(self, visit_id: str, path: Path, kind: str = "session") -> None:
        """Store a capture with a visit, whether or not it is open here."""

        def add(records: Records) -> Capture:
            from insole_core.workflows.records.capture_facts import capture_facts

            return records.captures.add(visit_id, kind, path, capture_facts(path))

        def added(_capture: Capture) -> None:
            self._services.messages.say(tr("The capture is in the record."))

        def missed(error: Exception) -> None:
            if visit_id == self._visit_id:
                self._refused[path] = kind
            self._services.keeper.note_refused(visit_id, error, self._services.messages.show_error)

        self._clinic.write(add, added, missed)

    def _begin(self) -> None:
        if self._services.keeper.visit_id != self._visit_id:
            self._visit_id, self._stored = self._services.keeper.visit_id, None
            self._refused.clear()
        self._look()

    def _move(self, _before: str, visit_id: str) -> None:
        """Store with the visit that has taken the place of a lost one what was meant for that."""
        of_feet = {Path(foot.source.path) for foot in self._case.record.feet}
        others = {path: kind for path, kind in self._refused.items() if path not in of_feet}
        self._begin()  # which stores the scans of the feet
        for path, kind in others.items():
            self.store(visit_id, path, kind)

    def _look(self) -> None:
        """Ask which captures the open visit has."""
        visit_id = self._visit_id
        if visit_id and self._clinic.is_open:
            self._clinic.ask(
                CHANNEL,
                lambda records: records.captures.of_visit(visit_id),
                lambda captures: self._take(visit_id, captures),
                lambda _error: None,
            )

    def _take(self, visit_id: str, captures: Sequence[Capture]) -> None:
        if visit_id != self._visit_id:
            return
        feet = self._case.record.feet
        here = {foot.source.sha256 for foot in feet}
        is_first, before = self._stored is None, self._stored or {}
        known = before.keys() | here
        new = [c for c in captures if not known & {c.source_sha256, c.content_sha256}]
        # A copy that was opened from the record is known by its content.
        self._stored = {
            digest: c.facts.taken_as
            for c in reversed(captures)  # the newest tells
            for digest in (c.source_sha256, c.content_sha256)
        } | before
        # Those that were there before are offered only where no foot was made yet.
        if new and not (is_first and feet):
            self._offer(new[0])
        self._store_new()

    def _offer(self, capture: Capture) -> None:
        sentence = tr("A new capture of this visit has come from {who} at {time}.")
        self._services.notices.put(
            NOTICE,
            sentence.format(who=capture.author, time=moment_text(capture.created_at)),
            (tr("Make a foot of it"), lambda: self._fetch(capture)),
        )

    def _fetch(self, capture: Capture) -> None:
        folder = self._services.paths.fetched_folder

        def copy(records: Records) -> Path:
            from insole_core.files.atomic import make_private_folder

            make_private_folder(folder)
            return records.captures.copy_to(capture, folder)

        self._clinic.ask(
            f"{CHANNEL}-copy", copy, self.fetched.emit, self._services.messages.show_error
        )

    def _store_new(self) -> None:
        """Store the scans of feet that the visit does not have yet."""
        if not self._visit_id or self._stored is None or self._clinic.is_read_only:
            return
        for foot in self._case.record.feet:
            source = foot.source
            is_own = not source.scanned_on  # else an earlier visit has it
            if is_own and not _has(self._stored, source) and _is_there(source):
                self._stored[source.sha256] = _taken_as(source)
                self.store(self._visit_id, Path(source.path), source.kind)


def _has(stored: Mapping[str, Side | None], source: ScanSource) -> bool:
    """Return whether a scan is stored; a session taken as the other foot is once more, as that."""
    side = _taken_as(source)
    return source.sha256 in stored and (side is None or stored[source.sha256] is side)


def _taken_as(source: ScanSource) -> Side | None:
    return source.choice.side if source.kind == "session" else None


def _is_there(source: ScanSource) -> bool:
    try:
        return Path(source.path).exists()
    except (OSError, ValueError):  # a path of another system
        return False
