"""The photos of a visit: added from files, drawn on, and stored at once."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject
from PySide6.QtGui import QImage
from shiboken6 import isValid

from insole_core.errors import Conflict, InputError, InsoleError, RecordsError, Unreachable
from insole_core.records.field_checks import MOST_NAME
from insole_core.records.photo import Photo, marks_of, marks_to_json
from insole_studio.document.clinic_record import RecordState
from insole_studio.document.kept_visit import MOST_REVISIONS
from insole_studio.document.waiting_work import LeftWork, WaitingWork
from insole_studio.features.records.photos_dialog import PhotosDialog
from insole_studio.services.app_services import AppServices
from insole_studio.services.files import Kept
from insole_studio.services.user_messages import LONG_MS
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_core.records.records import Records

log = logging.getLogger(__name__)

_READ, _PICTURE = "records-photos", "records-photo"


class VisitPhotos(QObject):
    """Opens the photos of visits, one at a time."""

    def __init__(self, services: AppServices) -> None:
        super().__init__(services.window)
        self._services = services
        self._visits: dict[str, _PhotosOfVisit] = {}
        self._waiting = WaitingWork(
            services.paths.waiting_photos_folder, services.messages.show_sentence
        )
        self._left: dict[str, LeftWork] = {}
        """What was drawn in a window that ended before it was stored."""
        services.clinic.state_changed.connect(self._store_left)
        services.keeper.lost.connect(self._leave_lost)
        services.keeper.moved.connect(self._move)

    def close(self) -> None:
        """Leave what is not stored to the next window that starts."""
        self._waiting.close()

    def _store_left(self) -> None:
        clinic = self._services.clinic
        if not clinic.is_writable or not clinic.may_show_patients:
            return
        self._left |= {left.key: left for left in self._waiting.take_over()}
        for left in list(self._left.values()):
            clinic.write(
                partial(_store_drawn, left=left),
                partial(self._drop_left, left.key),
                partial(self._miss_left, left.key),
            )

    def _drop_left(self, photo_id: str, is_there: bool) -> None:
        is_first = self._left.pop(photo_id, None) is not None
        self._waiting.drop(photo_id)
        if is_first and is_there:
            self._services.messages.say(
                tr("What was drawn on a photo and not saved yet is now in the record."), LONG_MS
            )

    def _miss_left(self, photo_id: str, error: Exception) -> None:
        """Leave on the disk what the record does not take now; set aside what it never will."""
        if not isinstance(error, InsoleError):
            raise error
        if isinstance(error, InputError):
            if self._left.pop(photo_id, None) is not None:
                self._waiting.set_aside(photo_id, error)
        else:
            log.warning("what was drawn on a photo is not in the record yet: %s", error)

    def _leave_lost(self) -> None:
        """Let the notice be seen and taken that tells what becomes of a lost visit."""
        if (photos := self._visits.get(self._services.keeper.visit_id)) is not None:
            photos.leave()

    def _move(self, before: str, visit_id: str) -> None:
        """Add to the visit that has taken the place of a lost one what was meant for that."""
        if (photos := self._visits.pop(before, None)) is not None:
            self._visits[visit_id] = photos
            photos.move(visit_id)

    def open(self, visit_id: str) -> None:
        """Show the photos of a visit."""

        def show(photos: list[Photo]) -> None:
            if visit_id not in self._visits:
                self._visits[visit_id] = _PhotosOfVisit(
                    visit_id, self._services, self._waiting, self
                )
            self._visits[visit_id].show(photos)

        self._services.clinic.ask(
            _READ,
            lambda r: r.photos.of_visit(visit_id),
            show,
            self._services.messages.show_error,
        )


class _PhotosOfVisit(QObject):
    """Shows the photos of one visit, and stores what is drawn on them, also once they are closed.

    A visit has one of its own, so that no late answer comes to the photos of another patient.
    """

    def __init__(
        self, visit_id: str, services: AppServices, waiting: WaitingWork, parent: QObject
    ) -> None:
        super().__init__(parent)
        self._waiting = waiting
        self._services = services
        self._clinic = services.clinic
        self._clinic.state_changed.connect(self._note_state)
        self._dialog: PhotosDialog | None = None
        self._visit_id = visit_id
        self._stored: dict[str, Photo] = {}
        """As the record has them."""
        self._wanted: dict[str, Photo] = {}
        """As they are drawn here, while they are not stored so."""
        self._refused: list[Path] = []
        """Pictures that the record did not take for this visit."""
        self._is_storing = False
        self._told = ""
        """Why nothing could be stored last; empty since something was."""

    def show(self, photos: Sequence[Photo]) -> None:
        """Show photos as they were read, with what is not stored yet."""
        self._stored = {
            photo.id: max(photo, self._stored.get(photo.id, photo), key=lambda p: p.revision)
            for photo in photos
        }
        for gone in self._wanted.keys() - self._stored.keys():
            self._forget(gone)
        dialog = PhotosDialog(
            tr("Photos of the visit"),
            self._services.window,
            why_not_change=self._clinic.why_read_only,
        )
        dialog.finished.connect(dialog.deleteLater)
        dialog.add_requested.connect(self._ask_to_add)
        dialog.delete_requested.connect(self._ask_to_delete)
        dialog.photo_chosen.connect(self._read_picture)
        dialog.edited.connect(self._edit)
        self._dialog = dialog
        dialog.show_photos(self._now)
        dialog.open()

    def leave(self) -> None:
        """Close the photos, if they are shown."""
        if self._dialog is not None and isValid(self._dialog):
            self._dialog.reject()

    def move(self, visit_id: str) -> None:
        """Be the photos of another visit from now on, also those that the record did not take."""
        self._visit_id = visit_id
        refused, self._refused = self._refused, []
        for path in refused:
            self._add(path)

    def _ask_to_add(self) -> None:
        questions = self._services.messages.questions.on(self._over)
        path = questions.file_to_open(tr("Photos") + " (*.jpg *.jpeg *.png)", Kept.PICTURES)
        if path is not None:
            self._add(path)

    def _add(self, path: Path) -> None:
        visit_id = self._visit_id

        def added(photo: Photo) -> None:
            self._stored[photo.id] = photo
            self._show(photo.id)

        def missed(error: Exception) -> None:
            if isinstance(error, RecordsError) and not isinstance(error, Unreachable):
                self._refused.append(path)  # the visit may be lost, and kept as another one
            self._services.keeper.note_refused(visit_id, error, self._tell)

        self._clinic.write(lambda r: r.photos.add(visit_id, path), added, missed)

    def _ask_to_delete(self, photo_id: str) -> None:
        photo = self._stored[photo_id]
        if not self._services.messages.questions.on(self._over).may_delete_photo():
            return

        def deleted(_nothing: None) -> None:
            self._stored.pop(photo_id, None)
            self._forget(photo_id)
            self._show()

        self._clinic.write(lambda r: r.photos.delete(photo), deleted, self._tell)

    def _read_picture(self, photo_id: str) -> None:
        photo = self._stored.get(photo_id)
        if photo is None:
            return

        def show(picture: bytes) -> None:
            if self._dialog is not None and isValid(self._dialog):
                self._dialog.show_picture(photo_id, QImage.fromData(picture))

        self._clinic.ask(_PICTURE, lambda r: r.photos.picture(photo), show, self._tell)

    def _edit(self, photo: Photo) -> None:
        self._wanted[photo.id] = photo
        self._keep(photo)
        self._store_next()

    def _keep(self, photo: Photo) -> None:
        """Keep on the disk what is drawn until it is stored."""
        drawn = {
            "caption": photo.caption,
            "marks": marks_to_json(photo.marks),
            "revision": self._stored[photo.id].revision,
        }
        self._waiting.keep(photo.id, self._visit_id, drawn)

    def _forget(self, photo_id: str) -> None:
        self._wanted.pop(photo_id, None)
        self._waiting.drop(photo_id)

    def _note_state(self) -> None:
        """Store what waited for the record to be back; one that was closed gives no answer."""
        if self._clinic.state is RecordState.CLOSED:
            self._is_storing = False
        self._store_next()

    def _store_next(self) -> None:
        """Store one photo after the other; of several wishes for one only the last one counts."""
        if self._is_storing or not self._wanted or not self._clinic.is_open:
            return
        self._is_storing = True
        wanted = next(iter(self._wanted.values()))
        revision = self._stored[wanted.id].revision

        def change(records: Records) -> Photo:
            return records.photos.change(wanted, revision)

        def stored(photo: Photo) -> None:
            self._is_storing = False
            self._told = ""
            if photo.id in self._stored:  # not deleted meanwhile
                self._stored[photo.id] = photo
            self._drop(wanted)
            self._store_next()

        self._clinic.write(change, stored, lambda error: self._miss(wanted, error))

    def _miss(self, wanted: Photo, error: Exception) -> None:
        """Tell that a photo could not be stored; what can never be is shown as the record has it.

        All else is kept, and stored with the next change or when the record is back.
        """
        self._is_storing = False
        if wanted.id not in self._stored:
            self._store_next()
        elif isinstance(error, Conflict):
            self._stored[wanted.id] = error.theirs
            self._refuse(self._wanted[wanted.id], error)  # drawn over what is no longer so
        elif isinstance(error, InputError):
            self._refuse(wanted, error)
        else:
            self._wanted[wanted.id] = self._wanted.pop(wanted.id)  # after those of other photos
            if self._told != str(error):
                self._told = str(error)
                self._tell(error)

    def _refuse(self, wanted: Photo, error: Exception) -> None:
        self._drop(wanted)
        self._show()
        self._tell(error)
        self._store_next()

    def _drop(self, wanted: Photo) -> None:
        """Drop a wish; a newer one that has taken its place is based on what is stored now."""
        if self._wanted.get(wanted.id) is wanted:
            self._forget(wanted.id)
        elif wanted.id in self._wanted and wanted.id in self._stored:
            self._keep(self._wanted[wanted.id])

    def _show(self, chosen: str = "") -> None:
        if self._dialog is not None and isValid(self._dialog):
            self._dialog.show_photos(self._now, chosen)

    @property
    def _now(self) -> Sequence[Photo]:
        return [self._wanted.get(photo.id, photo) for photo in self._stored.values()]

    @property
    def _over(self) -> PhotosDialog:
        assert self._dialog is not None
        return self._dialog

    def _tell(self, error: Exception) -> None:
        over = self._dialog if self._dialog is not None and isValid(self._dialog) else None
        self._services.messages.show_error(error, over=over or self._services.window)


def _store_drawn(records: Records, left: LeftWork) -> bool:
    """Store what was drawn on a photo; what somebody else has drawn since stays beside it.

    Returns
    -------
    bool
        Whether the photo is still there.

    Raises
    ------
    RecordsError
        When the record has no such visit: it may be another clinic's.
    InputError
        When the file of it is damaged, or together it is more than a photo takes.
    """
    records.visits.get(left.visit_id)
    photos = {photo.id: photo for photo in records.photos.of_visit(left.visit_id)}
    theirs = photos.get(left.key)
    if theirs is None:  # deleted since
        return False
    caption = left.content.text("caption", empty=True)
    marks = marks_of(left.content)
    if left.content.integer("revision", 0, MOST_REVISIONS) != theirs.revision:
        captions = dict.fromkeys(filter(None, (theirs.caption, caption)))
        caption = " · ".join(captions)[:MOST_NAME]
        marks = (*theirs.marks, *(mark for mark in marks if mark not in theirs.marks))
    mine = replace(theirs, caption=caption, marks=marks).checked()
    if mine != theirs:
        records.photos.change(mine, theirs.revision)
    return True
