"""Reads a pressure map or a footprint, asks what it does not say, and lays it under its foot."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QDialog

from insole_core.cases.case_record import FootRecord
from insole_core.errors import InputError
from insole_core.geometry.side import Side
from insole_core.progress import Progress
from insole_core.workflows.plantar_pressure import with_picture, with_pressure
from insole_studio.document.plantar_view import PlantarLayer, PlantarView
from insole_studio.features.design.actions.edit_actions import EditActions
from insole_studio.features.design.actions.view_actions import SideBySideActions
from insole_studio.features.design.models.color_maps import MapKind
from insole_studio.services.app_services import AppServices
from insole_studio.services.files import Kept
from insole_studio.texts import tr, translate_core_message

if TYPE_CHECKING:
    from insole_core.pressure.picture import Picture
    from insole_core.pressure.recording import PressureRecording
    from insole_core.workflows.lay_plantar import LaidPicture, LaidPressure

CHANNEL = "plantar"
_DOUBT = "plantar-doubt"


class PlantarActions:
    """Lays maps and pictures under the feet of the case."""

    def __init__(
        self,
        services: AppServices,
        view: PlantarView,
        side_by_side: SideBySideActions,
        edit: EditActions,
    ) -> None:
        self._services = services
        self._case = services.case
        self._view = view
        self._side_by_side = side_by_side
        self._edit = edit
        self._dialog: QDialog | None = None
        self._doubted: tuple[Side, PlantarLayer] | None = None
        self._case.changed.connect(self._forget_doubts_of_gone)

    def leave_case(self) -> None:
        """Stop what is read, asked or aligned, before another case comes."""
        self._services.jobs.cancel(CHANNEL)
        if self._dialog is not None:
            self._dialog.reject()

    def ask(self) -> None:
        """Let the user choose a file, and open it."""
        from insole_core.formats.file_formats import patterns
        from insole_core.pressure.picture import SUFFIXES as PICTURE_SUFFIXES
        from insole_core.pressure.read_pressure import SUFFIXES

        endings = patterns((*SUFFIXES, *PICTURE_SUFFIXES))
        kinds = tr("Pressure map or footprint") + f" ({endings})"
        path = self._services.messages.questions.file_to_open(kinds, Kept.SCANS)
        if path is not None:
            self.open(path)

    def open(self, path: Path) -> None:
        """Read a file in the background, and ask what it does not say."""
        from insole_core.pressure.picture import SUFFIXES as PICTURE_SUFFIXES
        from insole_core.pressure.picture import read_picture_file
        from insole_core.pressure.read_pressure import read_pressure

        def read(_progress: Progress) -> Picture | tuple[PressureRecording, ...]:
            is_picture = path.suffix.lower() in PICTURE_SUFFIXES
            return read_picture_file(path) if is_picture else read_pressure(path)

        def ask(found: Picture | tuple[PressureRecording, ...]) -> None:
            if isinstance(found, tuple):
                self._ask_pressure(path.name, found)
            else:
                self._ask_picture(found)

        self._services.run(CHANNEL, read, ask)

    def _ask_pressure(self, name: str, recordings: tuple[PressureRecording, ...]) -> None:
        from insole_core.workflows.lay_plantar import lay_pressure
        from insole_studio.features.design.plantar.plantar_dialogs import PressureDialog

        dialog = PressureDialog(name, recordings, self._sides, self._services.window)

        def lay() -> None:
            recording, answers, shown = dialog.recording, dialog.answers, dialog.shown
            assert answers.side is not None, "the dialog asks for it"
            foot = self._foot(answers.side)
            if foot is None:
                return

            def align(_progress: Progress) -> LaidPressure:
                return lay_pressure(foot.foot, recording, answers, shown, name)

            def take(laid: LaidPressure) -> None:
                now = self._still(foot)
                if now is not None:
                    changed = with_pressure(now, laid.pressure)
                    self._apply(changed, PlantarLayer.PRESSURE, laid.doubts)

            self._services.run(CHANNEL, align, take)

        self._open(dialog, lay)

    def _ask_picture(self, picture: Picture) -> None:
        from insole_core.workflows.lay_plantar import lay_picture
        from insole_studio.features.design.plantar.plantar_dialogs import PictureDialog

        dialog = PictureDialog(picture, self._sides, self._services.window)

        def lay() -> None:
            side, view = dialog.answered_side, dialog.answered_view
            foot = self._foot(side)
            if foot is None:
                return
            scaled = dialog.scaled()

            def align(_progress: Progress) -> LaidPicture:
                return lay_picture(foot.foot, scaled, view)

            def take(laid: LaidPicture) -> None:
                now = self._still(foot)
                if now is not None:
                    changed = with_picture(now, laid.picture)
                    self._apply(changed, PlantarLayer.PICTURE, laid.doubts)

            self._services.run(CHANNEL, align, take)

        self._open(dialog, lay)

    def _open(self, dialog: QDialog, lay: Callable[[], None]) -> None:
        self._dialog = dialog
        dialog.finished.connect(self._forget_dialog)
        dialog.accepted.connect(lay)
        dialog.open()

    def _forget_dialog(self, _result: int) -> None:
        self._dialog = None

    @property
    def _sides(self) -> list[Side]:
        return [foot.side for foot in self._case.record.feet]

    def _foot(self, side: Side) -> FootRecord | None:
        """Return the foot of a side; tell where the case has none."""
        foot = self._case.record.of_side(side)
        if foot is None:
            self._services.messages.show_error(
                InputError(
                    "The case has no {side} foot, so the map has none to lie under; open its scan "
                    "first.",
                    side=side,
                )
            )
        return foot

    def _still(self, foot: FootRecord) -> FootRecord | None:
        """Return the foot the map was aligned to as it is now; tell where it is gone."""
        now = self._case.record.of_side(foot.side)
        if now is not None and now.foot is foot.foot:
            return now
        self._services.messages.show_error(
            InputError(
                "The {side} foot was changed while the map was being aligned to it, so the map was "
                "not laid; lay it again.",
                side=foot.side,
            )
        )
        return None

    def _apply(self, changed: FootRecord, layer: PlantarLayer, doubts: tuple[str, ...]) -> None:
        self._case.apply(changed, tr("Lay a map under the foot"))
        self._side_by_side.show_map(MapKind.PRESSURE)
        self._edit.take_tool("plantar")
        self._view.want(layer)
        if doubts:
            self._doubted = changed.foot.side, layer
            text = " ".join(map(translate_core_message, doubts))
            self._services.notices.put(_DOUBT, text)
        else:
            self._services.notices.drop(_DOUBT)

    def _forget_doubts_of_gone(self) -> None:
        """Remove what was said about a map that was removed, also by undo or with its foot."""
        if self._doubted is None:
            return
        side, layer = self._doubted
        foot = self._case.record.of_side(side)
        if foot is None or _map_of(foot, layer) is None:
            self._doubted = None
            self._services.notices.drop(_DOUBT)


def _map_of(foot: FootRecord, layer: PlantarLayer) -> object:
    plantar = foot.plantar
    return plantar.picture if layer is PlantarLayer.PICTURE else plantar.pressure
