"""One visit of the time line: its day, what was prescribed, and small pictures, made one by one."""

from __future__ import annotations

import html
from collections import OrderedDict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QImage, QPixmap
from PySide6.QtWidgets import (
    QCheckBox,
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QVBoxLayout,
)

from insole_core.errors import InsoleError, Unreachable
from insole_core.geometry.side import Side
from insole_core.records.prescription import VersionSummary
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.features.records.rows import PictureKey, VisitRow
from insole_studio.texts import tr
from insole_studio.widgets.elided_label import ElidedLabel
from insole_studio.widgets.form_parts import allow
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.side_switch import side_letter

if TYPE_CHECKING:
    from insole_core.records.records import Records
    from insole_core.workflows.records.thumbnails import Rgba, Thumbnails

PICTURE_PX = QSize(56, 128)
FOOT, INSOLE = "foot", "insole"

CHANNEL = "records-pictures"
_KEPT = 200


class VisitCard(QFrame):
    """A frame with the visit's pictures, texts and buttons; both signals carry its id."""

    action_requested = Signal(str, str)
    """The key of an action, and the id of the visit."""
    compare_toggled = Signal(str, bool)

    def __init__(self, row: VisitRow) -> None:
        super().__init__()
        self.setObjectName("card")
        self.row = row
        self._pictures: dict[PictureKey, QLabel] = {}
        self._heading = ElidedLabel(f"{row.day}   {row.reason}".strip())
        self._heading.setObjectName("numbers")
        self._note = MessageLabel("quiet")
        self._note.say_all(row.notes)
        self.scan = MessageLabel("quiet")
        self.scan.say_all(row.scan)
        self.scan.setAccessibleDescription("; ".join(row.scan_details))
        self.scan.setToolTip("<br>".join(map(html.escape, row.scan_details)))
        self.compare = QCheckBox(tr("Compare"))
        self.compare.toggled.connect(self._toggle_compare)
        allow(self.compare, self._why_no_feet)
        if row.feet:
            self.compare.setToolTip(tr("Choose two visits to compare them"))
        self._lay_out()

    def show_picture(self, key: PictureKey, image: QImage) -> None:
        """Show a small picture in place of its placeholder; an empty one takes that away."""
        label = self._pictures.get(key)
        if label is None:
            return
        label.setVisible(not image.isNull())
        if image.isNull():
            return
        shown = QPixmap.fromImage(image).scaled(
            PICTURE_PX * label.devicePixelRatio(),
            Qt.AspectRatioMode.KeepAspectRatio,
            Qt.TransformationMode.SmoothTransformation,
        )
        shown.setDevicePixelRatio(label.devicePixelRatio())
        label.setPixmap(shown)

    def _lay_out(self) -> None:
        top = QHBoxLayout()
        top.setSpacing(8)
        top.addWidget(self._heading, 1)
        top.addWidget(self.compare)
        for key, text in (
            ("open", tr("Open")),
            ("edit", tr("Edit…")),
            ("photos", self._photos_text),
            ("versions", tr("Versions…")),
            ("delete", tr("Delete")),
        ):
            top.addWidget(self._button(key, text))
        layout = QVBoxLayout(self)
        layout.setContentsMargins(12, 8, 12, 8)
        layout.setSpacing(8)
        layout.addLayout(top)
        layout.addWidget(self._note)
        if self.row.feet:
            layout.addLayout(self._content())
        layout.addWidget(self.scan)

    @property
    def _photos_text(self) -> str:
        count = self.row.photos
        return tr("Photos ({count})…").format(count=count) if count else tr("Photos…")

    def _content(self) -> QHBoxLayout:
        """Return the pictures of the feet, with what is prescribed beside them."""
        pictures = QHBoxLayout()
        pictures.setSpacing(4)
        words = QGridLayout()
        words.setHorizontalSpacing(8)
        for number, foot in enumerate(self.row.feet):
            for kind in (FOOT, INSOLE):
                pictures.addWidget(self._picture(PictureKey(self.row.id, foot.side, kind)))
            words.addWidget(side_letter(foot.side), 2 * number, 0)
            label = QLabel(foot.text)
            label.setWordWrap(True)
            words.addWidget(label, 2 * number, 1)
            version = MessageLabel("numbers" if foot.is_signed else "quiet")
            version.say(foot.version)
            words.addWidget(version, 2 * number + 1, 1)
        words.setColumnStretch(1, 1)
        words.setRowStretch(2 * len(self.row.feet), 1)
        content = QHBoxLayout()
        content.setSpacing(16)
        content.addLayout(pictures)
        content.addLayout(words, 1)
        return content

    def _button(self, key: str, text: str) -> QPushButton:
        button = QPushButton(text)
        button.setProperty("action", key)
        button.setAccessibleName(f"{text} {self.row.day}")
        if key == "versions":
            allow(button, self._why_no_feet)
        if key == "delete":
            button.setToolTip(tr("Deletes a visit that holds nothing; any other one is kept"))
        button.clicked.connect(self._request)
        return button

    @property
    def _why_no_feet(self) -> str:
        return "" if self.row.feet else tr("This visit has no foot yet.")

    def _picture(self, key: PictureKey) -> QLabel:
        label = QLabel()
        label.setObjectName("picture")
        label.setFixedSize(PICTURE_PX)
        label.setAlignment(Qt.AlignmentFlag.AlignCenter)
        label.setAccessibleName(_name_of(key))
        label.setToolTip(_name_of(key))
        self._pictures[key] = label
        return label

    def _request(self) -> None:
        self.action_requested.emit(self.sender().property("action"), self.row.id)

    def _toggle_compare(self, on: bool) -> None:
        self.compare_toggled.emit(self.row.id, on)


def _name_of(key: PictureKey) -> str:
    if key.kind == FOOT:
        return tr("Left foot") if key.side is Side.LEFT else tr("Right foot")
    return tr("Left insole") if key.side is Side.LEFT else tr("Right insole")


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
        clinic.state_changed.connect(self._make_next)

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
        if not (self._wanted and self._clinic.is_open) or self._clinic.jobs.is_running(CHANNEL):
            return
        wanted = self._wanted
        version = wanted.pop(0)

        def make(records: Records) -> Thumbnails:
            from insole_core.workflows.records.thumbnails import thumbnails

            return thumbnails(records.prescriptions.read(version.id))

        def made(pictures: Thumbnails) -> None:
            insole = QImage() if pictures.insole is None else _image(pictures.insole)
            images = _image(pictures.foot), insole
            self._made[_Version(version.id, version.revision)] = images
            while len(self._made) > _KEPT:
                self._made.popitem(last=False)
            self._put(version, images)
            self._make_next()

        def missed(error: Exception) -> None:
            if not isinstance(error, InsoleError):
                raise error
            if isinstance(error, Unreachable):  # it comes when the database is back
                wanted.insert(0, version)
                return
            self._put(version, (QImage(), QImage()))
            self._make_next()

        self._clinic.ask(CHANNEL, make, made, missed)

    def _put(self, version: VersionSummary, images: tuple[QImage, QImage]) -> None:
        for kind, image in zip((FOOT, INSOLE), images, strict=True):
            self._show(PictureKey(version.visit_id, version.side, kind), image)


def _image(picture: Rgba) -> QImage:
    height, width, _four = picture.shape
    packed = picture.tobytes()
    return QImage(packed, width, height, 4 * width, QImage.Format.Format_RGBA8888).copy()
