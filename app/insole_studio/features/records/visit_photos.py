"""The photos of a visit: added from files, drawn on, and stored at once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject
from PySide6.QtGui import QImage
from shiboken6 import isValid

from insole_core.errors import Conflict
from insole_core.records.photo import Photo
from insole_studio.features.records.photos_dialog import PhotosDialog
from insole_studio.services.app_services import AppServices
from insole_studio.services.last_folders import Kept
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_core.records.records import Records

_READ, _PICTURE = "records-photos", "records-photo"


class VisitPhotos(QObject):
    """Shows the photos of one visit at a time, and stores what is drawn on them."""

    def __init__(self, services: AppServices) -> None:
        super().__init__(services.window)
        self._services = services
        self._clinic = services.clinic
        self._dialog: PhotosDialog | None = None
        self._visit_id = ""
        self._stored: dict[str, Photo] = {}
        """As the record has them."""
        self._wanted: dict[str, Photo] = {}
        """As they are drawn here, while they are not stored so."""
        self._is_storing = False

    def open(self, visit_id: str) -> None:
        """Show the photos of a visit."""
        self._visit_id = visit_id

        def show(photos: list[Photo]) -> None:
            self._stored = {photo.id: photo for photo in photos}
            dialog = PhotosDialog(
                tr("Photos of the visit"),
                self._services.window,
                editable=not self._clinic.is_read_only,
            )
            dialog.finished.connect(dialog.deleteLater)
            dialog.add_requested.connect(self._ask_to_add)
            dialog.delete_requested.connect(self._ask_to_delete)
            dialog.photo_chosen.connect(self._read_picture)
            dialog.edited.connect(self._edit)
            self._dialog = dialog
            dialog.show_photos(photos)
            dialog.open()

        self._clinic.ask(_READ, lambda r: r.photos.of_visit(visit_id), show, self._tell)

    def _ask_to_add(self) -> None:
        questions = self._services.messages.questions.on(self._over)
        path = questions.file_to_open(tr("Photos") + " (*.jpg *.jpeg *.png)", Kept.PICTURES)
        visit_id = self._visit_id
        if path is None:
            return

        def added(photo: Photo) -> None:
            if self._visit_id == visit_id:
                self._stored[photo.id] = photo
                self._show(photo.id)

        self._clinic.write(lambda r: r.photos.add(visit_id, path), added, self._tell)

    def _ask_to_delete(self, photo_id: str) -> None:
        photo = self._stored[photo_id]
        if not self._services.messages.questions.on(self._over).may_delete_photo():
            return

        def deleted(_nothing: None) -> None:
            self._stored.pop(photo_id, None)
            self._wanted.pop(photo_id, None)
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
        self._store_next()

    def _store_next(self) -> None:
        """Store one photo after the other; of several wishes for one only the last one counts."""
        if self._is_storing or not self._wanted:
            return
        self._is_storing = True
        wanted = next(iter(self._wanted.values()))
        revision = self._stored[wanted.id].revision

        def change(records: Records) -> Photo:
            return records.photos.change(wanted, revision)

        def stored(photo: Photo) -> None:
            self._is_storing = False
            self._stored[photo.id] = photo
            if self._wanted.get(photo.id) is wanted:
                del self._wanted[photo.id]
            self._store_next()

        self._clinic.write(change, stored, lambda error: self._miss(wanted, error))

    def _miss(self, wanted: Photo, error: Exception) -> None:
        """Show a photo as the record has it: what was drawn here could not be stored."""
        self._is_storing = False
        self._wanted.pop(wanted.id, None)
        if isinstance(error, Conflict):
            self._stored[wanted.id] = error.theirs
        self._show()
        self._tell(error)
        self._store_next()

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
