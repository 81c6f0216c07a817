"""Presenters of the two 3-D panels: the foot in colour, and the preview of the insole."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from insole_core.cases.case_record import ReferencePlane
from insole_core.contact.change import SENTENCE, Change
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import NAMES
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import SurfacePicker
from insole_core.geometry.side import Side
from insole_core.geometry.surface_path import shortest_path
from insole_core.insole.elements import Correction
from insole_core.insole.outline.shoe_outline import shoe_outline
from insole_core.insole.prescription.design_totals import heel_lift_mm
from insole_core.pressure.laid_map import PlantarLayers
from insole_studio.document.case import Case
from insole_studio.document.case_names import choose_variant
from insole_studio.document.foot_display import FootDisplay
from insole_studio.document.insole_preview import InsolePreview
from insole_studio.document.load_view import LoadView
from insole_studio.document.plantar_view import PlantarView
from insole_studio.document.section_plane import SectionModel
from insole_studio.document.side_by_side import Beside, SideBySide
from insole_studio.features.design.models.color_maps import (
    LoadedVertices,
    MapKind,
    color_by,
    color_foot,
    is_sole,
    numbers_text,
    painted_foot,
    painted_insole,
)
from insole_studio.features.design.models.model_panel import ModelPanel
from insole_studio.features.design.models.side_by_side_layout import (
    NAME_ROOM_MM,
    is_right,
    names_over,
    pair_text,
    placed_beside,
)
from insole_studio.features.design.models.view_lines import axes_of, shoe_lines
from insole_studio.features.design.tools.hand import selected_element
from insole_studio.features.design.tools.key_point_tool import confidence, point_text, shown_points
from insole_studio.features.design.tools.metatarsal_line import NEAR_MM, clearance, selected_pelott
from insole_studio.features.design.tools.outline_tool import curve_of
from insole_studio.features.design.tools.tool import ContextMenuItem
from insole_studio.features.design.tools.tool_controller import ToolController
from insole_studio.scene.coloring import Coloring, ContourLines, contour_lines, on_display
from insole_studio.scene.guide_lines import GuideLines
from insole_studio.scene.pointer import MarkedPoint, PointerEvent
from insole_studio.scene.view_camera import Subject
from insole_studio.texts import localised, tr, translate_core_message

OUTLINE_STRIDE = 3
SECTION_POINTS = 192
_NOTHING = (object(),) * 8
_ON_TOP_MM = 0.5
"""Of the contact surface: further off are the walls and the bottom of an insole."""
_NO_VERTEX = np.zeros(0, dtype=np.int64)


@dataclass(frozen=True, eq=False)
class ShownModels:
    """What the 3-D panels show, and what a pointer in them acts on."""

    case: Case
    surface: InsolePreview
    section: SectionModel
    tool_controller: ToolController
    counterpart: SideBySide
    plantar: PlantarView
    load: LoadView


class ModelPresenter:
    """Keeps one panel in step with case, preview and tool; passes pointer events to the tool."""

    subject: Subject

    def __init__(self, panel: ModelPanel, shown: ShownModels) -> None:
        self.panel = panel
        self._counterpart = shown.counterpart
        self._case = shown.case
        self._surface = shown.surface
        self._section = shown.section
        self._tool_controller = shown.tool_controller
        self._plantar = shown.plantar
        self._load = shown.load
        self._painted: PlantarLayers | None = None
        """What lay under the foot when it was last painted over the surface."""
        self._loaded_vertices: LoadedVertices | None = None
        """Those of the mesh that was last coloured by how load moves."""
        self._load_beside: tuple[object, ...] = ()
        """What the mesh beside was last coloured by, if by how load moves."""
        self._marked: tuple[object, ...] = _NOTHING
        """State for which the marks were last drawn; several signals may report one change."""
        self._follow(shown)

    def _follow(self, shown: ShownModels) -> None:
        """Show what changes, when it changes."""
        case, tools = shown.case, shown.tool_controller
        case.foot_changed.connect(self.show_all)
        for signal in (case.changed, case.preview_changed, case.selection_changed):
            signal.connect(self.show_marks)
        tools.tool_changed.connect(self.show_marks)
        shown.surface.changed.connect(self.show_surface)
        shown.section.changed.connect(self._show_section)
        tools.gesture_ended.connect(self.rest)
        shown.counterpart.changed.connect(self.show_counterpart)
        for signal in (case.changed, case.preview_changed):
            signal.connect(self._follow_plantar)
        shown.plantar.changed.connect(self.paint)
        shown.load.changed.connect(self.paint_load)
        shown.load.told.connect(self._paint_load_beside)

    def _follow_plantar(self) -> None:
        """Paint again if what lies under the foot has moved."""
        if self._case.shown.plantar is not self._painted:
            self.paint()

    def paint(self) -> None:
        """Paint what lies under the foot over the surface, while that is asked for."""
        raise NotImplementedError

    def paint_load(self) -> None:
        """Colour the surface by how load moves, while that is asked for."""
        raise NotImplementedError

    @property
    def _shows_load(self) -> bool:
        """Whether the surface is coloured by how load moves."""
        raise NotImplementedError

    def _paint_load_beside(self) -> None:
        """Colour the mesh beside by its own change; it stays while the other one is drawn."""
        change = self._change_beside()
        told = () if change is None else self._load.untold_of(change)
        if (self._is_paired, change, told) != self._load_beside:
            self.show_counterpart()

    @property
    def _is_paired(self) -> bool:
        """Whether each of two variants is coloured by its own change."""
        is_variant = self._counterpart.kind is Beside.VARIANT
        return self._shows_load and self._load.is_both and is_variant

    def _change_beside(self) -> Change | None:
        built = self._counterpart.built
        return self._load.beside(built.design) if self._is_paired and built is not None else None

    def _coloring_beside(self) -> Coloring | None:
        """Return the colours of the mesh beside; None for its own."""
        change, mesh = self._change_beside(), self._beside()
        untold = () if change is None else self._load.untold_of(change)
        self._load_beside = self._is_paired, change, untold
        if change is None or mesh is None:
            return None
        loaded = LoadedVertices.of(change.sole, mesh.vertices, self._is_loaded_beside(mesh))
        return loaded.coloring(change, untold)

    def _is_loaded_beside(self, mesh: TriangleMesh) -> BoolArray:
        """(n,) which vertices of the mesh beside lie against sole or insole."""
        raise NotImplementedError

    @property
    def side(self) -> Side:
        """The side of the active foot."""
        return self._case.side or Side.LEFT

    @property
    def mesh(self) -> TriangleMesh | None:
        """The mesh of the subject."""
        raise NotImplementedError

    @property
    def bounds_mm(self) -> FloatArray | None:
        """The box (2, 3) of the subject."""
        return None if self.mesh is None else self.mesh.bounds_mm

    @property
    def whole_bounds_mm(self) -> FloatArray | None:
        """The box (2, 3) of the subject and the mesh beside it."""
        bounds, companion = self.bounds_mm, self.companion
        if bounds is None or companion is None:
            return bounds
        both = np.stack([bounds, companion.bounds_mm])
        low, high = both[:, 0].min(axis=0), both[:, 1].max(axis=0)
        return np.stack([low, high + np.array([0.0, NAME_ROOM_MM, 0.0])])

    @property
    def aside_mm(self) -> FloatArray:
        """How far the middle of the whole (3,) lies beside that of the subject."""
        whole, own = self.whole_bounds_mm, self.bounds_mm
        if whole is None or own is None:
            return np.zeros(3)
        return np.asarray(whole.mean(axis=0) - own.mean(axis=0))

    @property
    def companion(self) -> TriangleMesh | None:
        """The mesh beside the subject, placed there; None if there is none."""
        foot, mesh = self._case.record.current, self._beside()
        if self.mesh is None or mesh is None or foot is None:
            return None
        return placed_beside(self.mesh, mesh, is_right(foot, self._counterpart))

    def show_counterpart(self) -> None:
        """Show the mesh beside the subject, and the names of both."""
        foot, companion = self._case.record.current, self.companion
        self.panel.show_companion(companion, self._coloring_beside())
        if foot is None or self.mesh is None or companion is None:
            self.panel.show_names(())
        else:
            self.panel.show_names(names_over(foot, self._counterpart, self.mesh, companion))
        self._show_directions()

    def _show_directions(self) -> None:
        """Write the anatomical directions around the subject and what they hold for beside it."""
        side, boxes = self._case.side, self._directed()
        if side is not None and boxes:
            low, high = np.stack(boxes, axis=1)
            self.panel.show_directions(side, np.stack([low.min(axis=0), high.max(axis=0)]))

    def _directed(self) -> list[FloatArray]:
        """Return the boxes (2, 3) that the directions surround.

        Between two insoles of one side, a word beside one would be read as that of the other; the
        two feet of a pair have the same directions between them.
        """
        bounds, companion = self.bounds_mm, self.companion
        boxes = [] if bounds is None else [bounds]
        if companion is not None and self._counterpart.kind is Beside.VARIANT:
            boxes.append(companion.bounds_mm)
        return boxes

    def _take_companion(self) -> None:
        side = self._case.side
        if self._counterpart.kind is Beside.VARIANT:
            choose_variant(self._case, self._counterpart.variant)
        elif side is not None:
            self._case.take_foot(side.other)

    def _beside(self) -> TriangleMesh | None:
        """Return the mesh to show beside the subject, in its own frame."""
        raise NotImplementedError

    def place(self, x_mm: float, y_mm: float) -> tuple[float, float, float]:
        """Return the point of the shown surface at a position of the insole frame, mm."""
        raise NotImplementedError

    def start(self) -> tuple[float, float, float] | None:
        """Return where the keyboard cursor starts: where the tool asks, or at the selection."""
        element, foot = selected_element(self._case), self._case.foot
        grips = () if element is None or foot is None else element.grips(foot)
        place = self._tool_controller.tool.start(self._case) or (
            grips[0].place_mm if grips else None
        )
        return None if place is None else self.place(*place)

    def way(self, start: FloatArray, end: FloatArray) -> FloatArray | None:
        """Return the shortest way along the surface between two of its points (3,)."""
        surface = self._closed
        return None if surface is None else shortest_path(surface, start, end)

    @property
    def _closed(self) -> TriangleMesh | None:
        """The mesh of the subject, in one piece."""
        return self.mesh

    def covers(self, x_mm: float, y_mm: float) -> bool:
        """Return whether the insole covers a position of the insole frame."""
        return self._surface.covers(x_mm, y_mm)

    def clear(self) -> None:
        """Show nothing: whatever fails with the next case, this one is not taken for it."""
        self._marked, self._loaded_vertices = _NOTHING, None
        self.panel.clear()
        self.panel.show_side(None)
        self.panel.show_numbers("")
        self.panel.show_warning("")
        self.panel.show_empty("", {})

    def show_all(self) -> None:
        """Show the case after another foot was opened."""
        self._marked = _NOTHING
        foot = self._case.foot
        if foot is None:
            self.panel.clear()
            self.panel.show_side(self._case.side)
        else:
            day = foot.scanned_on
            self.panel.show_side(self._case.side, mirrored=foot.mirrored, scanned_on=day)
        self.show_surface()

    def rest(self) -> None:
        """Update what is not updated during a gesture."""
        raise NotImplementedError

    def show_surface(self) -> None:
        """Show the surface and what is drawn on it."""
        raise NotImplementedError

    def show_marks(self) -> None:
        """Show outlines, handles, key points and plane."""
        if self.mesh is None:
            return
        record = self._case.shown
        tool, plane = self._tool_controller.tool, self._section.plane
        turn = tool.foot_step
        state = (
            record,
            self._case.selection,
            tool,
            tool.sketch,
            tool.selection,
            self._surface.contact,
            plane,
            turn,
        )
        if all(a is b for a, b in zip(state, self._marked, strict=True)):
            return
        self._marked = state
        self.panel.show_outlines(*self._outlines())
        self.panel.show_handles(self._tool_controller.tool.handles(self._case, self))
        is_foot = self.subject is Subject.FOOT
        self.panel.show_key_points(self._points() if is_foot else ())
        self._show_guide()
        self.panel.show_axes(axes_of(self._case, tool) if is_foot else None)
        self.panel.show_turned(tool.foot_step if is_foot else None)
        self._show_plane(record.annotations.plane)
        self.panel.show_section(self._section_line())
        self.panel.show_sketch(self.places(np.array(tool.sketch).reshape(-1, 2)))

    @property
    def turns_view(self) -> bool:
        """Whether a drag beside all that can be dragged turns the view."""
        return self._tool_controller.tool.turns_view

    def press(self, event: PointerEvent) -> bool:
        """Start a gesture of the tool."""
        return self._tool_controller.press(event, self)

    def move(self, event: PointerEvent) -> None:
        """Continue the gesture."""
        self._tool_controller.drag(event)

    def release(self, event: PointerEvent) -> None:
        """Finish the gesture."""
        self._tool_controller.drag(event)

    def cancel(self) -> bool:
        """Cancel the gesture."""
        return self._tool_controller.cancel()

    def double_click(self, event: PointerEvent) -> bool:
        """Pass a double click to the tool; on the mesh beside the subject, make that one active."""
        if self._tool_controller.double_click(event, self):
            return True
        companion = self.companion
        if event.surface_mm is not None or companion is None:
            return False
        if SurfacePicker(companion).pick(*event.look.ray_at(*event.pixel)) is None:
            return False
        self._take_companion()
        return True

    def offers(self, event: PointerEvent) -> Sequence[ContextMenuItem]:
        """Return the context menu items for the pointer's position."""
        return self._tool_controller.offers(event, self)

    def wheel(self, event: PointerEvent, steps: float) -> bool:
        """Pass the wheel to the tool."""
        return self._tool_controller.wheel(event, steps)

    def nudge(self, event: PointerEvent, right: int, up: int) -> bool:
        """Pass an arrow key to the tool."""
        return self._tool_controller.nudge(event, right, up)

    def _show_plane(self, plane: ReferencePlane | None) -> None:
        size = 0.0
        if plane is not None and self.bounds_mm is not None:
            size = 1.15 * float(np.ptp(self.bounds_mm, axis=0).max())
        self.panel.show_plane(plane, size)

    def _points(self) -> list[MarkedPoint]:
        """Return the custom points, and the landmarks while their tool is chosen."""
        wanted = shown_points(self._case)
        if self._tool_controller.tool.key != "key_point":
            wanted = {name: place for name, place in wanted.items() if name not in NAMES}
        return [
            MarkedPoint(point_text(name), place, confidence(self._case, name))
            for name, place in wanted.items()
        ]

    def _show_guide(self) -> None:
        """Show what the tool measures, or how far the selected pad ends behind the heads."""
        measured = self._tool_controller.tool.measure(self._case, self)
        if measured is not None:
            self.panel.show_guide(measured.lines, measured.text, measured.place_mm)
            return
        pad = selected_pelott(self._case)
        found = clearance(self._case.shown, pad) if pad is not None else None
        if pad is None or found is None or abs(found.distance_mm) > NEAR_MM:
            self.panel.show_guide((), "")
            return
        way = self.places(np.stack([found.front, found.nearest]))
        lines = self.places(found.line), way
        place = self.panel.right_of(self._lines(pad)[0], way[0])
        self.panel.show_guide(lines, f"{localised(found.distance_mm)} mm", place)

    def _show_section(self) -> None:
        """Show the section in its place; its handles come with the other marks."""
        if self._tool_controller.tool.key == "section":
            self.show_marks()
        elif self.mesh is not None:
            self.panel.show_section(self._section_line())

    def _section_line(self) -> FloatArray | None:
        line = self._section.line(self._surface)
        if line is None:
            return None
        # Always as many points, so that a line that follows the pointer is only moved.
        numbers = np.linspace(0.0, len(line) - 1, SECTION_POINTS).round().astype(int)
        return line[numbers] + np.array([0.0, 0.0, self._lift_mm])

    @property
    def _lift_mm(self) -> float:
        """Height above the contact surface at which marks are drawn."""
        return self.place(0.0, 0.0)[2] - self._surface.height_mm(0.0, 0.0)

    def _outlines(self) -> tuple[list[FloatArray], list[FloatArray]]:
        design, selected = self._case.shown.design, selected_element(self._case)
        elements = () if design is None else design.active
        others = [one for one in elements if one.is_seen and one != selected]
        if self._tool_controller.tool.key in ("outline", "rim"):
            marked = [self._insole_outline()]
        else:
            marked = [] if selected is None else self._lines(selected)
        return [line for one in others for line in self._lines(one)], marked

    def _insole_outline(self) -> FloatArray:
        curve = curve_of(self._case.shown)[::OUTLINE_STRIDE]
        return self.places(np.concatenate([curve, curve[:1]]))

    def _lines(self, element: Correction) -> list[FloatArray]:
        """Return the lines of an element on the shown surface."""
        foot = self._case.foot
        return [] if foot is None else [self.places(line) for line in element.lines(foot)]

    def places(self, xy: FloatArray) -> FloatArray:
        """Return the points (n, 3) of the shown surface at positions (n, 2)."""
        return np.column_stack([xy, self._surface.heights_mm(xy) + self._lift_mm])


class FootPresenter(ModelPresenter):
    """Presenter of the coloured foot."""

    subject = Subject.FOOT
    _is_compared = False
    _is_painted = False
    _is_loaded = False
    """Whether the sole is coloured by how load moves."""
    _ghost = False
    """Whether the insole is shown translucently below the foot."""

    def __init__(self, panel: ModelPanel, shown: ShownModels, display: FootDisplay) -> None:
        super().__init__(panel, shown)
        self._loaded_mesh: TriangleMesh | None = None
        """That was last coloured by how load moves; unlike an insole's, its vertices never move."""
        self._display = display
        display.changed.connect(self._show_evened)

    @property
    def mesh(self) -> TriangleMesh | None:
        """The mesh of the foot."""
        return None if self._case.foot is None else self._case.foot.mesh

    def place(self, x_mm: float, y_mm: float) -> tuple[float, float, float]:
        """Return the point of the sole at a position: the contact surface without thickness."""
        design = self._case.shown.design
        thickness = design.thickness_mm if design is not None else 0.0
        return x_mm, y_mm, self._surface.height_mm(x_mm, y_mm) - thickness

    def show_all(self) -> None:
        """Show another foot."""
        super().show_all()
        foot = self._case.foot
        if foot is None:
            self.panel.show_empty(
                tr("No scan yet. Capture a foot, open a recorded session, or import a scan."),
                {
                    "capture": tr("Capture…"),
                    "open_session": tr("Open session…"),
                    "open_archive": tr("Import a scan…"),
                    "open_example": tr("Open the example"),
                },
            )
            return
        self._show_foot(foot)
        self._show_directions()
        self.show_marks()

    def show_difference(self, shown: bool) -> None:
        """Colour the sole by its difference to the other foot, or in its own colours."""
        self._is_compared = shown
        if self._case.foot is not None:
            self._show_foot(self._case.foot)

    def show_plantar(self, shown: bool) -> None:
        """Paint pressure map or footprint over the sole, or show the foot in its own colours."""
        self._is_painted = shown
        if self._case.foot is not None:
            self._show_foot(self._case.foot)

    def paint(self) -> None:
        """Paint what lies under the foot over its sole."""
        foot = self._case.foot
        if not self._is_painted or foot is None:
            return
        mesh = self._shown_mesh(foot)
        coloring = self._plantar_coloring(mesh)
        if not self.panel.move_mesh(mesh, mesh.vertex_normals, _NO_VERTEX, coloring):
            self._show_foot(foot)

    def _plantar_coloring(self, mesh: TriangleMesh) -> Coloring | None:
        self._painted = self._case.shown.plantar
        shown = self._plantar.shown(self._painted)
        return None if shown is None else painted_foot(shown, mesh, self._plantar.opacity)

    def _shown_mesh(self, foot: Foot) -> TriangleMesh:
        display = self._display.surface
        return foot.mesh if display is None else display.mesh

    def show_load(self, shown: bool) -> None:
        """Colour the sole by how load moves, or show the foot in its own colours."""
        if shown is not self._is_loaded:
            self._is_loaded = shown
            if self._case.foot is not None:
                self._show_foot(self._case.foot)
            self._paint_load_beside()

    def paint_load(self) -> None:
        """Colour the sole by how load moves."""
        foot = self._case.foot
        if not self._is_loaded or foot is None:
            return
        mesh = self._shown_mesh(foot)
        coloring = self._load_coloring(mesh)
        if not self.panel.move_mesh(mesh, mesh.vertex_normals, _NO_VERTEX, coloring):
            self._show_foot(foot)

    def _load_coloring(self, mesh: TriangleMesh) -> Coloring | None:
        change = self._load.change
        if change is None:
            return None
        loaded = self._loaded_vertices
        if loaded is None or loaded.sole is not change.sole or self._loaded_mesh is not mesh:
            loaded = LoadedVertices.of(change.sole, mesh.vertices, is_sole(mesh))
            self._loaded_vertices, self._loaded_mesh = loaded, mesh
        return loaded.coloring(change, self._load.untold_of(change))

    @property
    def _shows_load(self) -> bool:
        return self._is_loaded

    def _is_loaded_beside(self, mesh: TriangleMesh) -> BoolArray:
        return is_sole(mesh)

    def show_counterpart(self) -> None:
        """Show the other foot, and the difference to it."""
        super().show_counterpart()
        if self._is_compared and self._case.foot is not None:
            self._show_foot(self._case.foot)

    def _show_foot(self, foot: Foot) -> None:
        if self._is_loaded:
            mesh = self._shown_mesh(foot)
            self.panel.show_mesh(mesh, self._load_coloring(mesh))
            self.panel.show_numbers(translate_core_message(SENTENCE))
            return
        if self._is_painted:
            mesh = self._shown_mesh(foot)
            self.panel.show_mesh(mesh, self._plantar_coloring(mesh))
            self.panel.show_numbers("")
            return
        coloring = color_foot(foot, self._counterpart) if self._is_compared else None
        shown = self._display.surface
        if shown is None:
            self.panel.show_mesh(foot.mesh, coloring)
        else:
            self.panel.show_mesh(*on_display(shown, coloring))
        record = self._case.record.current
        text = ""
        if coloring is not None and record is not None:
            text = f"{pair_text(record, self._counterpart)}:  {numbers_text(coloring.values)}"
        self.panel.show_numbers(text)

    def _show_evened(self) -> None:
        if self._case.foot is not None:
            self._show_foot(self._case.foot)

    def _beside(self) -> TriangleMesh | None:
        built, foot = self._counterpart.built, self._case.foot
        if built is not None and foot is not None and self._is_paired:
            return self._shown_mesh(foot)
        if built is None or self._counterpart.kind is not Beside.FOOT:
            return None
        return built.foot_display.mesh

    def rest(self) -> None:
        """Update the translucent insole after a gesture."""
        self._show_ghost()

    def show_surface(self) -> None:
        """The foot stays; what is drawn on it follows the insole."""
        if self._case.foot is None:
            return
        self.show_marks()
        self._show_ghost()

    def show_ghost(self, shown: bool) -> None:
        """Show or hide the translucent insole."""
        self._ghost = shown
        self._show_ghost()

    def _show_ghost(self) -> None:
        """Show the insole below the foot; not during a gesture."""
        insole = self._surface.mesh
        if not self._ghost or insole is None:
            self.panel.show_ghost(None)
        elif not self._tool_controller.is_busy:
            lifted = insole.vertices + np.array([0.0, 0.0, self._lift_mm])
            self.panel.show_ghost(replace(insole, vertices=lifted))


class InsolePresenter(ModelPresenter):
    """Presenter of the insole's preview, shaded or with a colour map."""

    subject = Subject.INSOLE

    def __init__(self, panel: ModelPanel, shown: ShownModels) -> None:
        super().__init__(panel, shown)
        self._map = MapKind.NONE
        self._contours = True
        self._shoe = False
        self._shoe_lines: GuideLines | None = None
        self._loaded: tuple[tuple[Change, tuple[str, ...]], Coloring] | None = None
        """What the colours by the change of the pressure were last made of, and they themselves."""
        self._shoe_of: tuple[object, ...] | None = None
        """What the shown outline of a shoe was made of."""
        self._drawn: tuple[TriangleMesh | None, bool] = (None, False)
        """The mesh that the panel shows, and whether with contour lines."""
        shown.surface.failed.connect(self.panel.show_warning)

    @property
    def mesh(self) -> TriangleMesh | None:
        """The mesh of the insole."""
        return self._surface.mesh

    @property
    def _closed(self) -> TriangleMesh | None:
        return self._surface.closed_mesh

    def place(self, x_mm: float, y_mm: float) -> tuple[float, float, float]:
        """Return the point of the contact surface at a position."""
        return x_mm, y_mm, self._surface.height_mm(x_mm, y_mm)

    def show_map(self, kind: MapKind) -> None:
        """Colour the insole by a map."""
        self._map = kind
        self._show_mesh_anew()
        self._paint_load_beside()

    def show_counterpart(self) -> None:
        """Show the other insole, and the difference to it."""
        super().show_counterpart()
        if self._map is MapKind.DIFFERENCE:
            self._show_mesh_anew()

    @property
    def map_kind(self) -> MapKind:
        """The colour map of the insole."""
        return self._map

    def paint(self) -> None:
        """Paint what lies under the foot over the insole."""
        mesh, normals = self._surface.mesh, self._surface.normals
        if self._map is not MapKind.PRESSURE or mesh is None or normals is None:
            return
        if not self.panel.move_mesh(mesh, normals, _NO_VERTEX, self._coloring()):
            self._show_mesh_anew()

    def paint_load(self) -> None:
        """Colour the insole by how load moves."""
        mesh, normals = self._surface.mesh, self._surface.normals
        if self._map is not MapKind.LOAD or mesh is None or normals is None:
            return
        if mesh is not self._drawn[0]:
            return  # the insole has changed too: it is about to be shown, in these colours
        if not self.panel.move_mesh(mesh, normals, _NO_VERTEX, self._coloring()):
            self._show_mesh_anew()

    def _load_coloring(self) -> Coloring | None:
        """Return the colours, the same while neither change nor vertices' places differ."""
        change, mesh = self._load.change, self._surface.mesh
        if change is None or mesh is None or self._surface.bottom_heights_mm is None:
            return None
        untold = self._load.untold_of(change)
        loaded = self._loaded_vertices
        if loaded is None or not loaded.are_those_of(change.sole, mesh.vertices):
            is_top = self._is_top(len(self._surface.bottom_heights_mm))
            loaded = LoadedVertices.of(change.sole, mesh.vertices, is_top)
            self._loaded_vertices, self._loaded = loaded, None
        of = change, untold
        if self._loaded is None or self._loaded[0] != of:
            self._loaded = of, loaded.coloring(change, untold)
        return self._loaded[1]

    @property
    def _shows_load(self) -> bool:
        return self._map is MapKind.LOAD

    def _is_loaded_beside(self, mesh: TriangleMesh) -> BoolArray:
        built = self._counterpart.built
        assert built is not None
        off_mm = mesh.vertices[:, 2] - built.contact.height_at(mesh.vertices[:, :2])
        return np.asarray(np.abs(off_mm) < _ON_TOP_MM)

    def _is_top(self, size: int) -> BoolArray:
        """(n,) which vertices of the mesh belong to the upper side."""
        return self._surface.values_everywhere(np.ones(size), np.zeros(size)) > 0

    def _plantar_coloring(self) -> Coloring | None:
        self._painted = self._case.shown.plantar
        shown, mesh = self._plantar.shown(self._painted), self._surface.mesh
        bottom = self._surface.bottom_heights_mm
        if shown is None or mesh is None or bottom is None:
            return None
        is_top = self._is_top(len(bottom))
        return painted_insole(shown, mesh.vertices, is_top, self._plantar.opacity)

    def _beside(self) -> TriangleMesh | None:
        built = self._counterpart.built
        return None if built is None else built.solid

    def rest(self) -> None:
        """Redraw the contour lines."""
        self._show_contours()

    def show_contours(self, shown: bool) -> None:
        """Show or hide contour lines of height, one per millimetre."""
        self._contours = shown
        self._show_contours()

    def show_all(self) -> None:
        """Show the insole of another foot, or in another theme."""
        self._shoe_of = None
        super().show_all()

    def show_shoe(self, shown: bool) -> None:
        """Show or hide the outline of a shoe around the insole."""
        self._shoe = shown
        self._show_shoe()

    def _show_shoe(self) -> None:
        foot, design = self._case.foot, self._case.shown.design
        worn = None if design is None else design.outline.shoe
        wanted = self._shoe or worn is not None
        if not wanted or foot is None or design is None or self._surface.mesh is None:
            self._shoe_of = None
            self._draw_shoe(None)
            return
        made_of = foot, design.outline, design.shell, heel_lift_mm(design), self._shoe
        if made_of != self._shoe_of:  # not for every step of a pad
            self._shoe_of = made_of
            lines = shoe_lines(shoe_outline(foot, design))
            # An insole that is wider than its shoe is shown unasked.
            self._draw_shoe(lines if self._shoe or lines.faults else None)

    def _draw_shoe(self, lines: GuideLines | None) -> None:
        self.panel.show_shoe(lines)
        if lines is not self._shoe_lines:
            self._shoe_lines = lines
            self._show_directions()

    def show_grazing_light(self, on: bool) -> None:
        """Light the insole from the side, or from ahead."""
        self.panel.show_grazing_light(on)

    def show_wireframe(self, shown: bool) -> None:
        """Show only edges, or the whole surface."""
        self.panel.show_wireframe(shown)

    def show_surface(self) -> None:
        """Show the current preview."""
        mesh, normals = self._surface.mesh, self._surface.normals
        self._show_shoe()
        if mesh is None or normals is None:
            self._drawn = None, False
            self._show_why_empty()
        elif self.panel.move_mesh(mesh, normals, self._surface.moved, self._coloring()):
            self._show_contours()
            self.show_marks()
        else:
            self._show_mesh_anew()

    def _show_mesh_anew(self) -> None:
        mesh, side = self._surface.mesh, self._case.side
        if mesh is None or side is None:
            return
        self.panel.show_mesh(mesh, self._coloring())
        self._show_directions()
        self._show_contours()
        self.show_marks()

    def _directed(self) -> list[FloatArray]:
        """Return the boxes of the insoles, and that of the shoe if it is shown."""
        boxes, shoe = super()._directed(), self._shoe_lines
        return boxes if shoe is None or not boxes else [*boxes, shoe.bounds_mm]

    def _coloring(self) -> Coloring | None:
        if self._map is MapKind.PRESSURE:
            self.panel.show_numbers("")
            return self._plantar_coloring()
        if self._map is MapKind.LOAD:
            self.panel.show_numbers(translate_core_message(SENTENCE))
            return self._load_coloring()
        coloring = color_by(self._map, self._surface, self._counterpart)
        foot, text = self._case.record.current, ""
        if coloring is not None and foot is not None and self._map is MapKind.DIFFERENCE:
            bottom = self._surface.bottom_heights_mm
            top = coloring.values[: 0 if bottom is None else len(bottom)]
            text = f"{pair_text(foot, self._counterpart)}:  {numbers_text(top)}"
        self.panel.show_numbers(text)
        return coloring

    def _show_contours(self) -> None:
        """Draw the contour lines, except during a gesture."""
        wanted = self._contours and not self._tool_controller.is_busy
        if self._drawn == (self._surface.mesh, wanted):
            return  # they are slow to draw, and one change emits several signals
        self._drawn = self._surface.mesh, wanted
        self.panel.show_contours(self._contour_lines() if wanted else None)

    def _contour_lines(self) -> ContourLines | None:
        mesh, normals, skins = self._surface.mesh, self._surface.normals, self._surface.skins
        if mesh is None or normals is None or skins is None:
            return None
        return contour_lines(mesh.vertices, normals, skins[0].triangles, skins[0].links.is_boundary)

    def _show_why_empty(self) -> None:
        is_start = self._case.foot is None
        if is_start:
            sentence = tr("The insole appears here as soon as there is a foot.")
            self.panel.show_empty(sentence, {"open": tr("Open case…")})
        else:
            self.panel.show_empty(tr("The insole is being built…"), {})
