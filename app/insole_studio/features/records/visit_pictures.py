"""Small pictures of the visits on a page, made one after the other in the background."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from PySide6.QtGui import QImage

from insole_core.errors import InsoleError
from insole_core.records.prescription import VersionSummary
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.features.records.rows import PictureKey
from insole_studio.features.records.visit_card import FOOT, INSOLE

if TYPE_CHECKING:
    from insole_core.records.records import Records
    from insole_core.workflows.records.thumbnails import Rgba, Thumbnails

CHANNEL = "records-pictures"
_KEPT = 200


@dataclass(frozen=True)
class _Version:
    """A version as it was when its picture was made."""

    id: str
    revision: int


class VisitPictures:
    """Makes pictures of versions, and remembers the last ones.

    Parameters
    ----------
    show
        Shows a picture in its place.
    """

    def __init__(self, clinic: ClinicRecord, show: Callable[[PictureKey, QImage], None]) -> None:
        self._clinic = clinic
        self._show = show
        self._made: OrderedDict[_Version, tuple[QImage, QImage]] = OrderedDict()
        self._wanted: list[VersionSummary] = []

    def want(self, versions: Sequence[VersionSummary]) -> None:
        """Show the pictures of versions, the first ones first; earlier wishes are forgotten."""
        self._wanted = []
        for version in versions:
            made = self._made.get(_Version(version.id, version.revision))
            if made is None:
                self._wanted.append(version)
            else:
                self._put(version, made)
        self._make_next()

    def _make_next(self) -> None:
        if not self._wanted or self._clinic.jobs.is_running(CHANNEL):
            return
        version = self._wanted.pop(0)

        def make(records: Records) -> Thumbnails:
            from insole_core.workflows.records.thumbnails import thumbnails

            return thumbnails(records.prescriptions.read(version.id))

        def made(pictures: Thumbnails) -> None:
            images = _image(pictures.foot), _image(pictures.insole)
            self._made[_Version(version.id, version.revision)] = images
            while len(self._made) > _KEPT:
                self._made.popitem(last=False)
            self._put(version, images)
            self._make_next()

        def missed(error: Exception) -> None:
            if not isinstance(error, InsoleError):
                raise error
            self._make_next()  # its place stays empty

        self._clinic.ask(CHANNEL, make, made, missed)

    def _put(self, version: VersionSummary, images: tuple[QImage, QImage]) -> None:
        for kind, image in zip((FOOT, INSOLE), images, strict=True):
            self._show(PictureKey(version.visit_id, version.side, kind), image)


def _image(picture: Rgba) -> QImage:
    height, width, _four = picture.shape
    packed = picture.tobytes()
    return QImage(packed, width, height, 4 * width, QImage.Format.Format_RGBA8888).copy()
