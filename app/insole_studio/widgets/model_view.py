"""The panel around one 3-D view: title, side, camera presets, scale, legend, and the empty page."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtGui import QResizeEvent
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
from insole_studio.scene.coloring import Coloring, ContourLines
from insole_studio.scene.guide_lines import GuideLines, NameLabel
from insole_studio.scene.pointer import Handle, MarkedPoint
from insole_studio.scene.scene_view import SceneView
from insole_studio.scene.view_camera import Preset, Subject
from insole_studio.texts import tr, translate_core_message, with_capital
from insole_studio.widgets.empty_page import EmptyPage
from insole_studio.widgets.legend import Legend, ScaleBar, SwatchLegend
from insole_studio.widgets.side_switch import SideBadge

MARGIN_PX = 8
LEAST_PX = (176, 128)
"""Width and height on the smallest screen."""


class ModelView(QWidget):
    """Panel of one 3-D view; implements `ModelPanel`."""

    preset_requested = Signal(object)
    action_requested = Signal(str)

    def __init__(
        self, subject: Subject, title: str, dark: bool, parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self.scene = SceneView(subject, dark, self)
        self.scene.camera_changed.connect(self.show_scale)
        self._bounds: FloatArray | None = None
        self._badge = SideBadge()
        self._has_side = False
        self._warning = QLabel()
        self._warning.setObjectName("warning")
        self._warning.setWordWrap(True)
        self._warning.hide()
        self.numbers = QLabel()
        self.numbers.setObjectName("numbers")
        self.numbers.setWordWrap(True)
        self.numbers.hide()
        self._scale = ScaleBar()
        self._legend, self._swatches = Legend(), SwatchLegend()
        self._left_px = 0
        self._empty = EmptyPage(self)  # without it, a window of its own would flash
        self._empty.chosen.connect(self.action_requested)
        self._pages = QStackedLayout()
        self._pages.addWidget(self._empty)
        self._pages.addWidget(self.scene)
        layout = QVBoxLayout()
        layout.setContentsMargins(MARGIN_PX, 4, MARGIN_PX, 4)
        layout.setSpacing(4)
        layout.addLayout(self._header())
        layout.addWidget(self._warning)
        layout.addWidget(self.numbers)
        layout.addLayout(self._pages, 1)
        layout.addWidget(self._swatches)
        layout.addLayout(self._footer())
        whole = QVBoxLayout(self)
        whole.setContentsMargins(0, 0, 0, 0)
        whole.setSpacing(0)
        if title:
            whole.addWidget(_strip(title))
        whole.addLayout(layout)

    def minimumSizeHint(self) -> QSize:
        """Return a size for a narrow screen: without the buttons of directions, which have keys."""
        return QSize(*LEAST_PX)

    def leave_room(self, left_px: int) -> None:
        """Show everything right of a strip at the left edge that a window covers; 0 for none."""
        left_px = max(0, min(left_px, self.width() - LEAST_PX[0]))
        layout = self.layout()
        assert layout is not None
        layout.setContentsMargins(left_px, 0, 0, 0)
        self._left_px = left_px
        self._fit_presets()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show the buttons of directions where there is room for all of them."""
        super().resizeEvent(event)
        self._fit_presets()

    def _fit_presets(self) -> None:
        width_px = self.width() - self._left_px
        beside_px = width_px - self._presets.sizeHint().width() - 3 * MARGIN_PX
        has_room = beside_px >= self._badge.least_px
        self._presets.setVisible(self._has_side and has_room)
        self._badge.fit(beside_px if has_room else width_px - 2 * MARGIN_PX)

    def show_side(self, side: Side | None, *, mirrored: bool = False, scanned_on: str = "") -> None:
        """Show the side on the badge, and orient the medial and lateral presets by it.

        Parameters
        ----------
        mirrored
            Whether the badge says that it is the mirror image of the other one.
        scanned_on
            Day of the earlier visit that the scan is of, for the badge; empty for none.
        """
        self._badge.show_side(side, mirrored=mirrored, scanned_on=scanned_on)
        self._has_side = side is not None
        self._fit_presets()
        if side is not None:
            self.scene.side = side

    def show_empty(self, sentence: str, offers: dict[str, str]) -> None:
        """Show a sentence and buttons instead of the scene.

        Parameters
        ----------
        sentence
            What to do next.
        offers
            Button texts by key; the first is the default.
        """
        self._empty.show_offers(sentence, offers)
        self._pages.setCurrentWidget(self._empty)
        self._scale.show_scale(0)

    def clear(self) -> None:
        """Let go of what the scene has shown."""
        self.scene.clear()
        self._show_legend(None)

    def show_mesh(
        self,
        mesh: TriangleMesh,
        coloring: Coloring | None = None,
    ) -> None:
        """Show a surface, and a legend if it is coloured by values.

        Parameters
        ----------
        mesh : mm, insole frame
            The surface.
        coloring
            By default the mesh's own colours, or those of the material.
        """
        self._pages.setCurrentWidget(self.scene)
        self._show_legend(coloring)
        self.scene.show_mesh(mesh, coloring)
        self.show_scale()

    def move_mesh(
        self,
        mesh: TriangleMesh,
        normals: FloatArray,
        moved: IntArray | None = None,
        coloring: Coloring | None = None,
    ) -> bool:
        """Move the vertices of the shown surface; see `Painter.move_surface`."""
        followed = self.scene.move_mesh(mesh, normals, moved, coloring)
        if followed:
            self._show_legend(coloring)
        return followed

    def _show_legend(self, coloring: Coloring | None) -> None:
        self._legend.show_coloring(coloring)
        self._swatches.show_swatches(() if coloring is None else coloring.swatches)

    def show_wireframe(self, shown: bool) -> None:
        """Show only the triangles' edges, or the whole surface."""
        self.scene.painter.show_wireframe(shown)
        self.scene.request_render()

    def show_shoe(self, lines: GuideLines | None) -> None:
        """Draw the outline of a shoe and its heights; None removes it."""
        if lines is None and not self.scene.is_open:
            return
        painter = self.scene.painter
        painter.show_lines("shoe", () if lines is None else lines.lines, painter.scheme.text, 1.5)
        faults = () if lines is None else lines.faults
        painter.show_lines("shoe-faults", faults, painter.scheme.alarm, 4.0)
        place, text = (None, "") if lines is None else (lines.place, lines.text)
        painter.show_label(place, text, "shoe-text")
        self.scene.request_render()

    def show_grazing_light(self, on: bool) -> None:
        """Light the surface from the side, or from ahead."""
        self.scene.painter.show_grazing_light(on)
        self.scene.request_render()

    def show_ghost(self, mesh: TriangleMesh | None) -> None:
        """Show a second, translucent surface; None removes it."""
        self.scene.painter.show_ghost(mesh)
        self.scene.request_render()

    def show_contours(self, lines: ContourLines | None) -> None:
        """Draw contour lines of height; None removes them."""
        self.scene.painter.show_contours(lines)
        self.scene.request_render()

    def show_guide(
        self, lines: Sequence[FloatArray], text: str, place_mm: FloatArray | None = None
    ) -> None:
        """Draw lines along which something is measured, and the measure.

        Parameters
        ----------
        lines : (n, 3) each, mm, insole frame
        text
            The measure.
        place_mm : (3,), mm, insole frame
            Where the text stands.
        """
        self.scene.painter.show_lines("guide", lines, self.scene.painter.scheme.mark, 2.0)
        self.scene.painter.show_label(place_mm, text)
        self.scene.request_render()

    def right_of(self, outline: FloatArray, place_mm: FloatArray) -> FloatArray:
        """Return the place beside a point (3,) that is right of a whole outline (n, 3)."""
        right = self.scene.look.right
        return np.asarray(place_mm + max(float(((outline - place_mm) @ right).max()), 0.0) * right)

    def show_turned(self, step: FloatArray | None) -> None:
        """Show the surface moved by a transform (4, 4) while it is being turned; None ends that."""
        self.scene.painter.show_moved(step)
        self.scene.request_render()

    def show_axes(self, axes: GuideLines | None) -> None:
        """Draw the rearfoot axes and their angle; None removes them."""
        lines = () if axes is None else axes.lines
        self.scene.painter.show_lines("axes", lines, self.scene.painter.scheme.accent, 2.5)
        place, text = (None, "") if axes is None or not axes.text else (axes.place, axes.text)
        self.scene.painter.show_label(place, text, "axes-angle")
        self.scene.request_render()

    def show_outlines(self, lines: Sequence[FloatArray], selected: Sequence[FloatArray]) -> None:
        """Draw the outlines of the corrections.

        Parameters
        ----------
        lines, selected : (n, 3) each, mm, insole frame
            Outlines; those of the selected correction are drawn stronger.
        """
        scheme = self.scene.painter.scheme
        self.scene.painter.show_lines("outlines", lines, scheme.mark, 2.0)
        self.scene.painter.show_lines("selected", selected, scheme.accent, 3.0)
        self.scene.request_render()

    def show_handles(self, handles: tuple[Handle, ...]) -> None:
        """Show the draggable handles."""
        self.scene.show_handles(handles)

    def show_key_points(self, points: Sequence[MarkedPoint]) -> None:
        """Show named points."""
        self.scene.painter.show_key_points(points)
        self.scene.request_render()

    def show_highlight(self, points: FloatArray) -> None:
        """Mark points (n, 3) and the line between them; no points remove the mark."""
        if len(points) == 0 and not self.scene.is_open:
            return
        painter = self.scene.painter
        lines = [points] if len(points) > 1 else []
        painter.show_lines("highlight", lines, painter.scheme.alarm, 2.5)
        painter.show_spots(np.empty((0, 3)), points, 12.0)
        self.scene.request_render()

    def show_plane(self, plane: ReferencePlane | None, size_mm: float) -> None:
        """Show the reference plane as a translucent square of this size."""
        self.scene.painter.show_plane(plane, size_mm)
        self.scene.request_render()

    def show_section(self, line: FloatArray | None) -> None:
        """Draw the section line (n, 3); None removes it."""
        lines = [] if line is None else [line]
        self.scene.painter.show_lines("section", lines, self.scene.painter.scheme.mark, 3.0)
        self.scene.request_render()

    def show_sketch(self, line: FloatArray) -> None:
        """Draw the line (n, 3) that is being sketched."""
        lines = [line] if len(line) > 1 else []
        self.scene.painter.show_lines("sketch", lines, self.scene.painter.scheme.accent, 3.0)
        self.scene.request_render()

    def show_directions(self, side: Side, bounds_mm: FloatArray) -> None:
        """Write the anatomical directions around the box (2, 3)."""
        self.scene.painter.show_directions(side, bounds_mm)
        self.scene.request_render()

    def show_companion(self, mesh: TriangleMesh | None, coloring: Coloring | None = None) -> None:
        """Show the mesh beside the subject, in the colours of the legend; None removes it."""
        if mesh is None and not self.scene.is_open:
            return
        self.scene.companion.show(mesh, coloring)
        self.scene.request_render()

    def show_names(self, names: Sequence[NameLabel]) -> None:
        """Show the names of the subject and of the mesh beside it."""
        if not names and not self.scene.is_open:
            return
        self.scene.companion.show_names(names)
        self.scene.request_render()

    def show_numbers(self, text: str) -> None:
        """Show the statistics of the displayed difference; an empty text hides them."""
        self.numbers.setText(text)
        self.numbers.setVisible(bool(text))

    def show_warning(self, text: str) -> None:
        """Show a warning above the view; an empty text hides it."""
        said = translate_core_message(text)
        self._warning.setText(with_capital(said))
        self._warning.setVisible(bool(text))

    def look_at_whole(self, bounds_mm: FloatArray, preset: Preset = Preset.PLANTAR) -> None:
        """Fit the box (2, 3) into the view, seen from a preset direction."""
        self._bounds = bounds_mm
        self.scene.set_camera(self.scene.aim_at(preset, bounds_mm))
        self.show_scale()

    def look_from(self, preset: Preset) -> None:
        """Change the viewing direction and fit the last box again."""
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
        header.setSpacing(MARGIN_PX)
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
        """Update the scale bar for the current camera."""
        shown = self._pages.currentWidget() is self.scene
        self._scale.show_scale(self.scene.look.mm_per_px if shown else 0)


def _strip(title: str) -> QLabel:
    """Return a title bar like those of the docks."""
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
