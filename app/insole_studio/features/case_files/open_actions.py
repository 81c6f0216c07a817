"""Open cases, sessions and meshes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from PySide6.QtWidgets import QWidget

from insole_core.cases.case_file import read_case
from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.errors import InsoleError
from insole_core.geometry.side import Side
from insole_core.progress import Progress
from insole_core.resources import resource_path
from insole_core.workflows.file_kind import kind_of
from insole_core.workflows.foot_landmarks import with_landmarks
from insole_core.workflows.scanned_feet import ScannedFoot
from insole_core.workflows.starting_design import StartingDevice, last_design, starting_device
from insole_studio.document.case_lock import CaseInUseError
from insole_studio.features.case_files.case_guard import CaseGuard, FileState
from insole_studio.features.case_files.save_actions import SaveActions
from insole_studio.services.app_services import AppServices
from insole_studio.services.files import Kept, case_kinds, scan_kinds
from insole_studio.services.questions import InUse, SameSide
from insole_studio.services.user_messages import LONG_MS
from insole_studio.texts import tr, translate_core_message

ImportScan = Callable[[Path, Side | None, str, Callable[[Sequence[ScannedFoot]], None]], None]
"""Opens a scan: path, side or None, channel of the jobs, and what is called with the feet."""
CHANNEL = "open"
NOTICE = "scan"
LINE_LETTERS = 160
"""Number of characters that the status bar of a small window shows."""
EXAMPLE = "example/example.insole"
_SAME_LENGTH = 0.03
"""Share by which the length of a foot may change when its scan is read again."""


class OpenActions:
    """Reads files in the background, then shows their content in the window."""

    def __init__(
        self,
        services: AppServices,
        saver: SaveActions,
        guard: CaseGuard,
        reconstruct: Callable[[Path], None],
        import_scan: ImportScan,
    ) -> None:
        self._services = services
        self._case = services.case
        self._messages = services.messages
        self._notices = services.notices
        self._recent = services.recent
        self._saver = saver
        self._guard = guard
        self._reconstruct = reconstruct
        self._import_scan = import_scan

    def open_path(self, path: Path, side: Side | None = None) -> None:
        """Open a case, a session or a mesh, depending on the path.

        Parameters
        ----------
        path
            Case file, session or mesh.
        side
            Side of a mesh; the user is asked if it is None.
        """
        try:
            kind = kind_of(path)
        except InsoleError as error:
            self._messages.show_error(error)
            return
        if kind == "case":
            self._open_case(path)
        elif kind == "mesh":
            self._open_mesh(path, side)
        else:
            self._open_session(path.parent if kind == "manifest" else path)

    def ask_open_case(self) -> None:
        """Let the user choose a case and open it."""
        self._open_chosen(self._messages.questions.file_to_open(case_kinds(), Kept.CASES))

    def ask_open_session(self) -> None:
        """Let the user choose the folder of a session and open it."""
        questions = self._messages.questions
        self._open_chosen(questions.folder_to_open(tr("Open session"), Kept.SCANS))

    def ask_open_mesh(self) -> None:
        """Let the user choose an archive or a mesh and open it."""
        self._open_chosen(self._messages.questions.file_to_open(scan_kinds(), Kept.SCANS))

    def new_case(self) -> None:
        """Start an empty case."""
        self._saver.after_unsaved(lambda: self._case.open(CaseRecord(), None))

    def cancel(self) -> None:
        """Stop reading a file: its case or its foot is not wanted any more."""
        self._services.jobs.cancel(CHANNEL)

    def open_example(self) -> None:
        """Open a copy of the example of the product, which no window locks or saves over."""

        def read(progress: Progress) -> CaseRecord:
            progress.step(0.0, tr("Opening the case"))
            return with_landmarks(read_case(resource_path(EXAMPLE)))

        def opened(record: CaseRecord) -> None:
            self._case.open(replace(record, patient=_invented(record.patient)), None)

        self._saver.after_unsaved(lambda: self._services.run(CHANNEL, read, opened))

    def take_scan(self, scanned: ScannedFoot, over: QWidget | None = None) -> bool:
        """Add a foot to the case; one reconstructed from the same scan keeps its design.

        A recording of one foot that was made as the other one before is no second foot: that one
        leaves the case.

        Parameters
        ----------
        over
            The window that the foot comes from; by default the main one.

        Returns
        -------
        bool
            False if the user does not want it, after all.
        """
        self._recent.remember(Path(scanned.source.path))
        before = self._case.record.of_side(scanned.foot.side)
        if before is not None and _is_same_scan(before, scanned):
            again = replace(before, foot=scanned.foot, source=scanned.source)
            self._take(again, scanned, tr("Reconstruct the foot again"))
            return True
        return self._put_on_bench(scanned, over)

    def _take(self, foot: FootRecord, scanned: ScannedFoot, sentence: str) -> None:
        """Put a foot into the case, and take the one away that its scan was mistaken for."""
        self._tell(scanned)
        is_mistaken = _mistaken(self._case.record, scanned) is not None
        self._case.apply(foot, sentence, only_foot=is_mistaken)

    def _tell(self, scanned: ScannedFoot) -> None:
        """Show how the scan was read; texts too long for the status bar become a notice."""
        # The latest findings concern the foot, the first ones the file.
        notes = " ".join(map(translate_core_message, reversed(scanned.foot.notes)))
        self._notices.drop(NOTICE)
        if len(notes) > LINE_LETTERS:
            self._notices.put(NOTICE, notes)
        else:
            self._messages.say(notes, LONG_MS)

    def _open_chosen(self, path: Path | None) -> None:
        if path is not None:
            self.open_path(path)

    def _open_case(self, path: Path) -> None:
        def read(progress: Progress) -> FileState:
            progress.step(0.0, tr("Opening the case"))
            return self._guard.read(path)

        def opened(state: FileState) -> None:
            self._guard.hold(state.lock)
            real = path.resolve()  # what was opened is saved, and not what a link leads to by then
            self._case.open(state.record, real, digest=state.digest)
            self._recent.remember(real)

        def failed(error: Exception) -> None:
            if isinstance(error, CaseInUseError):
                self._ask_how_to_open(path, str(error))
            else:
                self._messages.show_error(error)

        self._saver.after_unsaved(lambda: self._services.jobs.start(CHANNEL, read, opened, failed))

    def _ask_how_to_open(self, path: Path, sentence: str) -> None:
        """Open a case that another window has open, so that neither overwrites the other."""
        answer = self._messages.questions.about_case_in_use(sentence)
        if answer is InUse.CANCEL:
            return

        def read(progress: Progress) -> CaseRecord:
            progress.step(0.0, tr("Opening the case"))
            return with_landmarks(read_case(path))

        def opened(record: CaseRecord) -> None:
            if answer is InUse.READ_ONLY:
                self._case.open(record, path, read_only=True)
            else:
                self._case.open(record, None, unsaved=True)

        self._services.run(CHANNEL, read, opened)

    def _open_session(self, path: Path) -> None:
        self._reconstruct(path)

    def _open_mesh(self, path: Path, side: Side | None) -> None:
        def opened(feet: Sequence[ScannedFoot]) -> None:
            for scanned in feet:
                if scanned.warnings:
                    self._messages.show_sentence(
                        " ".join(map(translate_core_message, scanned.warnings))
                    )
                self.take_scan(scanned)

        self._import_scan(path, side, CHANNEL, opened)

    def _put_on_bench(self, scanned: ScannedFoot, over: QWidget | None) -> bool:
        """Add a foot to the case; one of the same side is replaced, or kept in the old case.

        Returns
        -------
        bool
            False if neither is wanted.
        """
        foot = self._begun(scanned)
        record = self._case.record
        before = record.of_side(foot.side)
        if not record.feet:
            self._tell(scanned)
            self._case.open_foot(foot.foot, foot.source, foot.design)
            return True
        starting = starting_device(self._services.paths.settings_folder)
        mistaken = _mistaken(record, scanned)
        if before is None and mistaken is not None:
            foot = replace(foot, earlier=last_design(mistaken, starting))
            self._take(foot, scanned, tr("Reconstruct the foot again"))
            return True
        if before is None:
            self._take(foot, scanned, _sentence_of_adding(foot.side))
            return True
        answer = SameSide.REPLACE
        # A capture was seen by nobody yet, as a scan was in the dialog that imports it.
        is_unseen, order = scanned.source.kind == "session", record.order.number
        if is_unseen or order or not _is_untouched(before, starting):
            questions = self._messages.questions.on(over or self._services.window)
            answer = questions.about_same_side(foot.side, order)
        if answer is SameSide.REPLACE:
            foot = replace(foot, earlier=last_design(before, starting))
            self._take(foot, scanned, tr("Put a new scan into the place of the old"))
        elif answer is SameSide.NEW_CASE:
            self._saver.after_unsaved(lambda: self._begin_case(scanned))
        return answer is not SameSide.CANCEL

    def _begin_case(self, scanned: ScannedFoot) -> None:
        foot = self._begun(scanned)
        self._case.open(CaseRecord.of_foot(foot), None, unsaved=True)
        self._tell(scanned)

    def _begun(self, scanned: ScannedFoot) -> FootRecord:
        """Return a foot whose design begins with the clinic's device."""
        starting = starting_device(self._services.paths.settings_folder)
        if starting.problem is not None:
            self._messages.show_sentence(starting.problem)
        design = starting.design(scanned.foot)
        return FootRecord.begun(scanned.foot, scanned.source, design)


def _is_untouched(foot: FootRecord, starting: StartingDevice) -> bool:
    """Return whether a foot has not been edited since its design began."""
    begun = FootRecord.begun(foot.foot, foot.source, foot.design)
    is_begun = (foot.variants, foot.annotations) == (begun.variants, begun.annotations)
    return is_begun and not starting.prescribes(foot.design)


def _invented(patient: Patient) -> Patient:
    """Return the patient of the example in the language of the window."""
    return replace(patient, name=tr("Example, Anna"), notes=tr("Forefoot pain when walking."))


def _sentence_of_adding(side: Side) -> str:
    return tr("Add the left foot") if side is Side.LEFT else tr("Add the right foot")


def _mistaken(record: CaseRecord, scanned: ScannedFoot) -> FootRecord | None:
    """Return the foot of the other side that was made of the same recording of one foot."""
    other = record.of_side(scanned.foot.side.other)
    if other is None or other.source.mirrored or not scanned.is_alone:
        return None
    return other if other.source.path == scanned.source.path else None


def _is_same_scan(before: FootRecord, scanned: ScannedFoot) -> bool:
    """Return whether a scan is the one in the case, and shows a foot of the same size and form.

    A file that is read in another unit or form gives another foot, on which no design fits.
    """
    same_file = before.source.path == scanned.source.path
    same_file = same_file or before.source.sha256 == scanned.source.sha256
    if scanned.source.kind == "session":
        return same_file
    same_form = before.foot.form is scanned.foot.form
    ratio = scanned.foot.length_mm / before.foot.length_mm
    return same_file and same_form and abs(ratio - 1) < _SAME_LENGTH
