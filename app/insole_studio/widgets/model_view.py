"""The panel around one 3-D view: title, side, camera presets, scale, legend, and the empty page."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import (
    QHBoxLayout,
    QLabel,
    QStackedLayout,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from insole_core.cases.case_record import ReferencePlane
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_studio.scene.coloring import Coloring
from insole_studio.scene.guide_lines import GuideLines
from insole_studio.scene.name_label import NameLabel
from insole_studio.scene.pointer import Handle, MarkedPoint
from insole_studio.scene.scene_view import SceneView
from insole_studio.scene.view_camera import Preset, Subject
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.empty_page import EmptyPage
from insole_studio.widgets.legend import Legend
from insole_studio.widgets.scale_bar import ScaleBar
from insole_studio.widgets.side_badge import SideBadge


class ModelView(QWidget):
    """Lays out one view and shows what its presenter says."""

    preset_requested = Signal(object)
    offer_chosen = Signal(str)

    def __init__(
        self, subject: Subject, title: str, dark: bool, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.scene = SceneView(subject, dark)
        self.scene.camera_changed.connect(self.show_scale)
        self._bounds: FloatArray | None = None
        self._badge = SideBadge()
        self._warning = QLabel()
        self._warning.setObjectName("warning")
        self._warning.setWordWrap(True)
        self._warning.hide()
        self.numbers = QLabel()
        self.numbers.setObjectName("numbers")
        self.numbers.setWordWrap(True)
        self.numbers.hide()
        self._scale = ScaleBar()
        self._legend = Legend()
        self._empty = EmptyPage()
        self._empty.chosen.connect(self.offer_chosen)
        self._pages = QStackedLayout()
        self._pages.addWidget(self._empty)
        self._pages.addWidget(self.scene)
        layout = QVBoxLayout()
        layout.setContentsMargins(8, 4, 8, 4)
        layout.setSpacing(4)
        layout.addLayout(self._header())
        layout.addWidget(self._warning)
        layout.addWidget(self.numbers)
        layout.addLayout(self._pages, 1)
        layout.addLayout(self._footer())
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(0)
        if title:
            whole.addWidget(_strip(title))
        whole.addLayout(layout)

    def show_side(self, side: Side | None) -> None:
        """Show the badge, and let medial and lateral follow it."""
        self._badge.show_side(side)
        self._presets.setVisible(side is not None)
        if side is not None:
            self.scene.side = side

    def show_empty(self, sentence: str, offers: dict[str, str]) -> None:
        """Say what comes next instead of a scene."""
        self._empty.show_offers(sentence, offers)
        self._pages.setCurrentWidget(self._empty)
        self._scale.show_scale(0)

    def clear(self) -> None:
        """Let go of what the scene has shown."""
        self.scene.clear()

    def show_mesh(
        self,
        mesh: TriangleMesh,
        coloring: Coloring | None = None,
    ) -> None:
        """Show a surface, and a legend where it is coloured by numbers."""
        self._pages.setCurrentWidget(self.scene)
        self._legend.show_coloring(coloring)
        self.scene.show_mesh(mesh, coloring)
        self.show_scale()

    def move_mesh(
        self,
        mesh: TriangleMesh,
        normals: FloatArray,
        moved: IntArray | None = None,
        coloring: Coloring | None = None,
    ) -> bool:
        """Move the surface that is shown; False when it is another."""
        followed = self.scene.move_mesh(mesh, normals, moved, coloring)
        if followed:
            self._legend.show_coloring(coloring)
            self.scene.request_render()
        return followed

    def show_wireframe(self, shown: bool) -> None:
        """Show edges alone, or the whole surface."""
        self.scene.painter.show_wireframe(shown)
        self.scene.request_render()

    def show_ghost(self, mesh: TriangleMesh | None) -> None:
        """Show a second surface through the first; None for none."""
        self.scene.painter.show_ghost(mesh)
        self.scene.request_render()

    def show_contours(self, step_mm: float) -> None:
        """Draw lines of equal height; 0 for none."""
        self.scene.painter.show_contours(step_mm)
        self.scene.request_render()

    def show_guide(
        self, lines: Sequence[FloatArray], text: str, beside: FloatArray | None = None
    ) -> None:
        """Draw what a pad is measured against, and the measure at the right of its outline."""
        self.scene.painter.show_lines("guide", lines, self.scene.painter.scheme.mark, 2.0)
        place = None
        if beside is not None:
            right, front = self.scene.look.right, lines[-1][0]
            place = front + max(float(((beside - front) @ right).max()), 0.0) * right
        self.scene.painter.show_label(place, text)
        self.scene.request_render()

    def show_turned(self, step: FloatArray | None) -> None:
        """Show the surface moved by a transform (4, 4), as long as the hand turns it."""
        self.scene.painter.show_moved(step)
        self.scene.request_render()

    def show_axes(self, axes: GuideLines | None) -> None:
        """Draw the lines seen from behind, and their angle."""
        lines = () if axes is None else axes.lines
        self.scene.painter.show_lines("axes", lines, self.scene.painter.scheme.accent, 2.5)
        place, text = (None, "") if axes is None or not axes.text else (axes.place, axes.text)
        self.scene.painter.show_label(place, text, "axes-angle")
        self.scene.request_render()

    def show_outlines(self, lines: Sequence[FloatArray], selected: Sequence[FloatArray]) -> None:
        """Draw the outlines of the corrections, the selected one stronger."""
        scheme = self.scene.painter.scheme
        self.scene.painter.show_lines("outlines", lines, scheme.mark, 2.0)
        self.scene.painter.show_lines("selected", selected, scheme.accent, 3.0)
        self.scene.request_render()

    def show_handles(self, handles: tuple[Handle, ...]) -> None:
        """Show what can be grabbed."""
        self.scene.show_handles(handles)

    def show_key_points(self, points: Sequence[MarkedPoint]) -> None:
        """Show named places."""
        self.scene.painter.show_key_points(points)
        self.scene.request_render()

    def show_highlight(self, points: FloatArray) -> None:
        """Mark places (n, 3) and the way between them; none hides what was marked."""
        painter = self.scene.painter
        lines = [points] if len(points) > 1 else []
        painter.show_lines("highlight", lines, painter.scheme.alarm, 2.5)
        painter.show_spots(np.empty((0, 3)), points, 12.0)
        self.scene.request_render()

    def show_plane(self, plane: ReferencePlane | None, size_mm: float) -> None:
        """Show the reference plane."""
        self.scene.painter.show_plane(plane, size_mm)
        self.scene.request_render()

    def show_section(self, line: FloatArray | None) -> None:
        """Draw where the section plane cuts."""
        lines = [] if line is None else [line]
        self.scene.painter.show_lines("section", lines, self.scene.painter.scheme.mark, 3.0)
        self.scene.request_render()

    def show_sketch(self, line: FloatArray) -> None:
        """Draw what the hand draws."""
        lines = [line] if len(line) > 1 else []
        self.scene.painter.show_lines("sketch", lines, self.scene.painter.scheme.accent, 3.0)
        self.scene.request_render()

    def show_directions(self, side: Side, bounds_mm: FloatArray) -> None:
        """Write the anatomical words around the box."""
        self.scene.painter.show_directions(side, bounds_mm)
        self.scene.request_render()

    def show_companion(self, mesh: TriangleMesh | None) -> None:
        """Show what stands beside the subject; None for nothing."""
        self.scene.companion.show(mesh)
        self.scene.request_render()

    def show_names(self, names: Sequence[NameLabel]) -> None:
        """Tell the subject and what stands beside it apart."""
        self.scene.companion.show_names(names)
        self.scene.request_render()

    def show_numbers(self, text: str) -> None:
        """Say how large the shown difference is; empty hides it."""
        self.numbers.setText(text)
        self.numbers.setVisible(bool(text))

    def show_warning(self, text: str) -> None:
        """Say what is wrong, above the view; empty hides it."""
        said = translate_core_message(text)
        self._warning.setText(said[:1].upper() + said[1:])
        self._warning.setVisible(bool(text))

    def look_at_whole(self, bounds_mm: FloatArray, preset: Preset = Preset.PLANTAR) -> None:
        """Show all that lies in the box (2, 3), from a named direction."""
        self._bounds = bounds_mm
        self.scene.set_camera(self.scene.aim_at(preset, bounds_mm))
        self.show_scale()

    def look_from(self, preset: Preset) -> None:
        """Look from another direction at what was shown as a whole."""
        if self._bounds is not None:
            self.look_at_whole(self._bounds, preset)

    def _header(self) -> QHBoxLayout:
        self._presets = QWidget()
        row = QHBoxLayout(self._presets)
        row.setContentsMargins(0, 0, 0, 0)
        row.setSpacing(0)
        for preset, text in _preset_texts().items():
            button = QToolButton()
            button.setText(text)
            button.setAutoRaise(True)
            button.setProperty("preset", preset.value)
            button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
            button.clicked.connect(self._request_preset)
            row.addWidget(button)
        header = QHBoxLayout()
        header.setSpacing(8)
        header.addWidget(self._badge)
        header.addStretch(1)
        header.addWidget(self._presets)
        return header

    def _footer(self) -> QHBoxLayout:
        footer = QHBoxLayout()
        footer.addWidget(self._scale)
        footer.addStretch(1)
        footer.addWidget(self._legend)
        return footer

    def _request_preset(self) -> None:
        self.preset_requested.emit(Preset(self.sender().property("preset")))

    def show_scale(self) -> None:
        """Show the ruler for the camera of now."""
        shown = self._pages.currentWidget() is self.scene
        self._scale.show_scale(self.scene.look.mm_per_px if shown else 0)


def _strip(title: str) -> QLabel:
    """A title like those of the docks."""
    strip = QLabel(title)
    strip.setObjectName("panel-strip")
    return strip


def _preset_texts() -> dict[Preset, str]:
    return {
        Preset.PLANTAR: tr("Plantar"),
        Preset.MEDIAL: tr("Medial"),
        Preset.LATERAL: tr("Lateral"),
        Preset.POSTERIOR: tr("Posterior"),
    }
