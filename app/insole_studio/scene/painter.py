"""Draw foot, insole, handles and marks on any pyvista plotter; independent of Qt."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import compress
from typing import Any

import numpy as np
import pyvista as pv

from insole_core.cases.case_record import ReferencePlane
from insole_core.geometry.arrays import FloatArray, IndexArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_studio.scene.coloring import MISSING, Coloring, ContourLines
from insole_studio.scene.name_tags import (
    NameTags,
    is_across_view,
    is_covered,
    moved_clear,
    moved_into_image,
    moved_off,
)
from insole_studio.scene.pointer import Handle, MarkedPoint
from insole_studio.scene.view_camera import ViewTransform
from insole_studio.texts import tr

MATERIAL = (232, 229, 222)
CONTOUR, PAPER = "#30363d", "#e0ddd6"
"""Colours of the contour lines, and of the ground of their labels."""
CONTOURS = {"contours": (0.3, 1.0), "strong-contours": (0.75, 1.6)}
"""Opacity and width of the contour lines."""
CONTOUR_LABELS, CONTOUR_PX = "contour-labels", 11
_SEEN = 0.5  # cosine of the steepest view on the contact surface that shows its labels
LIGHTS = (((0.0, 0.0, 1.0), 0.45), ((-1.0, 1.0, 1.0), 0.65))
"""Direction, seen from the camera, and intensity; the second, slanted, brings out the relief."""
GRAZING = (((0.0, 0.0, 1.0), 0.3), ((-1.0, 0.4, 0.3), 1.0))
"""The same, with the second one nearly along the surface."""
GHOST_OPACITY = 0.35
SURE = 0.6
NAME_PX, DIRECTION_PX, LABEL_PX = 12, 13, 13
HANDLE_PX = {"move": 22.0, "size": 17.0, "corner": 11.0}
"""Diameter of the handles with their rims."""
UNRIMMED = 0.72
"""Share of its diameter that a handle has without its rim."""
HANDLE_SHARE, LEAST_HANDLES = 0.7, 0.4
"""Share of the distance to their neighbours that handles and their rims take at most, and the share
of their size that they keep: those of a small pad do not hide it."""
POINTS_PER_INCH = 72
EYE_DISTANCE_MM = 1500.0
WORD_GAP_MM = (26.0, 22.0)
"""Distance of the anatomical directions from the surface, in x and in y."""


@dataclass(frozen=True)
class Scheme:
    """The colours of the scene in one theme.

    Accent, mark and alarm are drawn on pale feet and insoles, and in white rims, as well as before
    the background.
    """

    bottom: str
    top: str
    text: str
    accent: str
    mark: str
    alarm: str

    @classmethod
    def of(cls, dark: bool) -> Scheme:
        """Return the light or the dark scheme."""
        if dark:
            return cls("#24272b", "#3a3f45", "#e6e8ea", "#3a8ee0", "#d97000", "#f5503f")
        return cls("#dfe3e7", "#f7f8f9", "#33383d", "#1668b8", "#b35900", "#c22316")


class Painter:
    """Draws one view and owns its actors; each `show_…` replaces what it drew before."""

    def __init__(self, plotter: Any, dark: bool = False, pixel_ratio: float = 1.0) -> None:
        self._plotter = plotter
        self._ratio = 1.0
        self._surface: pv.PolyData | None = None
        self._mesh: TriangleMesh | None = None
        self._coloring: Coloring | None = None
        self._wireframe = False
        self._shapes: dict[str, tuple[object, ...]] = {}
        """Geometry and style of the shown marks; a mark that keeps both only moves."""
        self._in_front: dict[str, pv.PolyData] = {}
        """The points of those marks."""
        self._actors: dict[str, Any] = {}
        """Those that are drawn, by name: the plotter would look through all of them."""
        self._texts: dict[str, Callable[[], None]] = {}
        """Functions that redraw the shown texts."""
        self._tags = NameTags(plotter)
        self._named: Sequence[MarkedPoint] = ()
        self._directions: tuple[list[FloatArray], list[str]] = ([], [])
        self._written: tuple[FloatArray, list[str]] = (np.zeros((0, 3)), [])
        """Those of the directions that are shown, and where."""
        self._contour_labels: tuple[tuple[FloatArray, str], ...] = ()
        self._contour_labels_free: list[bool] | None = None
        """Which of them are written; None before they are."""
        self._handles: Sequence[Handle] = ()
        self._labels: dict[str, tuple[FloatArray, str]] = {}
        """Places and texts of the shown labels."""
        self._look: ViewTransform | None = None
        self.scheme = Scheme.of(dark)
        plotter.remove_all_lights()
        self._lights = [pv.Light(light_type="camera light") for _ in LIGHTS]
        for light in self._lights:
            plotter.add_light(light)
        self.show_grazing_light(False)
        plotter.enable_parallel_projection()
        self.set_pixel_ratio(pixel_ratio)
        self.set_dark(dark)

    @property
    def shown(self) -> frozenset[str]:
        """Names of what is drawn."""
        return frozenset(self._plotter.actors)

    def clear(self) -> None:
        """Show nothing at all."""
        self._mesh = self._surface = self._coloring = None
        self._shapes.clear()
        self._in_front.clear()
        self._texts.clear()
        self._directions, self._written = ([], []), (np.zeros((0, 3)), [])
        self._contour_labels, self._contour_labels_free = (), None
        self._handles = ()
        self._labels.clear()
        self._named = ()
        self._tags.show((), NAME_PX, self.scheme.text, self.scheme.bottom)
        self._actors.clear()
        self._plotter.renderer.clear_actors()

    def set_pixel_ratio(self, ratio: float) -> None:
        """Set how many pixels of the picture make one of the window, on a screen of this scale.

        Texts have their sizes in points, of which a pixel of the window is one.
        """
        by, self._ratio = ratio / self._ratio, ratio
        self._plotter.render_window.SetDPI(round(POINTS_PER_INCH * ratio))
        self._tags.pixel_ratio = ratio
        for actor in self._plotter.actors.values():
            if isinstance(actor, pv.Actor):
                actor.prop.line_width *= by
                actor.prop.point_size *= by

    def set_dark(self, dark: bool) -> None:
        """Change the colours of background, text and marks."""
        before, self.scheme = self.scheme, Scheme.of(dark)
        self._plotter.set_background(self.scheme.bottom, top=self.scheme.top)
        for name in self._shapes:
            self._recolor(name, before)
        self._shapes.clear()
        self._in_front.clear()
        for write in list(self._texts.values()):
            write()
        self._tags.show(self._named, NAME_PX, self.scheme.text, self.scheme.bottom)

    def _recolor(self, name: str, before: Scheme) -> None:
        """Recolour an actor from the previous colour scheme to the current one."""
        actor = self._actors.get(name)
        for role in ("accent", "mark", "alarm"):
            if actor is not None and actor.prop.color == pv.Color(getattr(before, role)):
                actor.prop.color = getattr(self.scheme, role)
                return

    def show_surface(
        self,
        mesh: TriangleMesh | None,
        coloring: Coloring | None = None,
    ) -> None:
        """Show the foot or the insole.

        Parameters
        ----------
        mesh : mm, insole frame
            The surface; None removes it.
        coloring
            By default the mesh's own colours, or those of the material.
        """
        self._mesh = mesh
        self._remove("surface")
        self._surface = None
        if mesh is None or len(mesh.triangles) == 0:
            return
        self._surface = polydata(mesh)
        self._add(
            self._surface,
            name="surface",
            smooth_shading=False,
            specular=0.0,
            style="wireframe" if self._wireframe else "surface",
            **surface_look(self._surface, mesh, coloring),
        )
        self._coloring = coloring

    def move_surface(
        self,
        mesh: TriangleMesh,
        normals: FloatArray,
        moved: IntArray | None = None,
        coloring: Coloring | None = None,
    ) -> bool:
        """Move the vertices of the shown surface without rebuilding it.

        Parameters
        ----------
        mesh : mm, insole frame
            The surface with its new vertex positions.
        normals : (n, 3) float64
            Unit normals of its vertices.
        moved
            Indices of the vertices that moved; by default all.
        coloring
            Of the same kind as the shown one.

        Returns
        -------
        bool
            False if triangles or kind of colouring differ; nothing is changed then.
        """
        if self._surface is None or self._mesh is None:
            return False
        if self._mesh.triangles is not mesh.triangles or _kind(coloring) != _kind(self._coloring):
            return False
        self._mesh = mesh
        if moved is None or len(moved):  # what did not move need not be handed over again
            which = slice(None) if moved is None else moved
            self._surface.points[which] = mesh.vertices[which]
            self._surface.point_data["Normals"][which] = normals[which]
        if coloring is not None and coloring is not self._coloring:
            self._recolor_surface(self._surface, coloring)
        self._surface.Modified()
        return True

    def _recolor_surface(self, surface: pv.PolyData, coloring: Coloring) -> None:
        self._coloring = coloring
        if coloring.painted is not None:
            surface.point_data["painted"][:] = coloring.painted
        else:
            surface.point_data["values"][:] = coloring.values
            self._limit_to(coloring.limits)

    def show_moved(self, step: FloatArray | None) -> None:
        """Show the surface moved by a transform (4, 4); None shows it in place."""
        actor = self._actors.get("surface")
        if actor is not None:
            actor.user_matrix = np.eye(4) if step is None else step

    def show_wireframe(self, shown: bool) -> None:
        """Show only the triangles' edges, or the whole surface."""
        self._wireframe = shown
        actor = self._actors.get("surface")
        if actor is not None:
            actor.prop.style = "wireframe" if shown else "surface"

    def show_ghost(self, mesh: TriangleMesh | None) -> None:
        """Show a second, translucent surface; None removes it."""
        self._remove("ghost")
        if mesh is None:
            return
        self._add(
            polydata(mesh),
            name="ghost",
            color=self.scheme.accent,
            opacity=GHOST_OPACITY,
            specular=0.0,
            smooth_shading=False,
        )

    def show_contours(self, lines: ContourLines | None) -> None:
        """Draw contour lines of height on the surface, and their labels; None removes them."""
        none = np.empty((0, 2, 3))
        self._draw_contour("contours", none if lines is None else lines.thin)
        self._draw_contour("strong-contours", none if lines is None else lines.strong)
        self._contour_labels = () if lines is None else lines.labels
        self._contour_labels_free = None
        self._show_contour_labels()

    def _draw_contour(self, name: str, segments: FloatArray) -> None:
        self._remove(name)
        if len(segments) == 0:
            return
        opacity, width = CONTOURS[name]
        self._add(
            pv.line_segments_from_points(segments.reshape(-1, 3)),
            name=name,
            color=CONTOUR,
            opacity=opacity,
            line_width=width * self._ratio,
            lighting=False,
        )

    def _show_contour_labels(self) -> None:
        """Write those labels of contour lines that cover no handle and no other label.

        They are hidden when the contact surface is not seen from above.
        """
        free = [True] * len(self._contour_labels)
        if self._look is not None and free:
            boxes = self._boxes_of_contour_labels(self._look)
            free = (~is_covered(boxes, self._taken(self._look))).tolist()
        if free != self._contour_labels_free:
            self._contour_labels_free = free
            labels = list(compress(self._contour_labels, free))
            self._show_texts(
                CONTOUR_LABELS,
                [place for place, _ in labels],
                [text for _, text in labels],
                CONTOUR_PX,
                centred=True,
                boxed=True,
                colors=(CONTOUR, PAPER),
            )
        actor = self._actors.get(CONTOUR_LABELS)
        if actor is not None and self._look is not None:
            actor.visibility = bool(self._look.back[2] > _SEEN)

    def _boxes_of_contour_labels(self, look: ViewTransform) -> FloatArray:
        """Return left, top, right, bottom (n, 4) of the labels of contour lines, px."""
        middle = look.pixels_of(np.array([place for place, _ in self._contour_labels]))
        half = _half_sizes_px([text for _, text in self._contour_labels], CONTOUR_PX)
        return np.hstack([middle - half, middle + half])

    def _taken(self, look: ViewTransform) -> FloatArray:
        """Return left, top, right, bottom (n, 4) of handles and labels, px."""
        middle = look.pixels_of(np.array([h.position_mm for h in self._handles]).reshape(-1, 3))
        radius = np.array([[HANDLE_PX[h.kind] / 2] for h in self._handles])
        radius = radius.reshape(-1, 1)
        handles = np.hstack([middle - radius, middle + radius])
        return np.concatenate([handles, self._label_boxes(look)])

    def _label_boxes(self, look: ViewTransform) -> FloatArray:
        """Return left, top, right, bottom (n, 4) of the labels, which stand right of their place.

        The boxes are in px.
        """
        places = np.array([place for place, _ in self._labels.values()]).reshape(-1, 3)
        half = _half_sizes_px([text for _, text in self._labels.values()], LABEL_PX)
        beside = look.pixels_of(places) + half * [1.0, 0.0]
        return np.hstack([beside - half, beside + half])

    def show_grazing_light(self, on: bool) -> None:
        """Light the surface from the side, so that every bump casts its shade, or from ahead."""
        for light, (position, intensity) in zip(
            self._lights, GRAZING if on else LIGHTS, strict=True
        ):
            light.position, light.intensity = position, intensity

    def show_lines(self, name: str, lines: Iterable[FloatArray], color: str, width: float) -> None:
        """Draw polylines in front of everything, replacing those of the same name.

        Parameters
        ----------
        name
            Name of the actor.
        lines : (n, 3) each, mm, insole frame
            Open or closed polylines.
        color
            Any colour that pyvista accepts.
        width
            Line width, pixels.
        """
        parts = list(lines)
        points = np.concatenate(parts) if parts else np.empty((0, 3))
        self._show_in_front(
            name,
            points,
            tuple(len(part) for part in parts),
            color=color,
            line_width=width * self._ratio,
        )

    def show_handles(self, handles: Sequence[Handle]) -> None:
        """Show draggable handles of constant size on the screen."""
        for kind, size in HANDLE_PX.items():
            places = [h.position_mm for h in handles if h.kind == kind]
            self._show_dots(f"rim-{kind}", places, size, "white")
            self._show_dots(f"handles-{kind}", places, size * UNRIMMED, self.scheme.accent)
        self._handles = handles
        self._show_contour_labels()

    def show_key_points(self, points: Sequence[MarkedPoint]) -> None:
        """Show points with their names; uncertain ones are highlighted."""
        if not points and not self._named:
            return
        for name, wanted in (("sure", True), ("unsure", False)):
            places = [p.position_mm for p in points if (p.confidence >= SURE) is wanted]
            color = self.scheme.accent if wanted else self.scheme.mark
            self._show_dots(f"rim-{name}", places, 13.0, "white")
            self._show_dots(f"points-{name}", places, 9.0, color)
        self._named = points
        self._tags.show(points, NAME_PX, self.scheme.text, self.scheme.bottom)
        if self._look is not None:
            self._place_names(self._look)

    def show_spots(
        self, spots_mm: FloatArray, chosen_mm: FloatArray, chosen_px: float = 6.0
    ) -> None:
        """Mark places that need attention.

        Parameters
        ----------
        spots_mm : (n, 3) float64
            All marked places.
        chosen_mm : (m, 3) float64
            Those to emphasise.
        chosen_px
            Size of the emphasised marks.
        """
        self._show_dots("spots", list(spots_mm), 4.0, self.scheme.mark)
        self._show_dots("spots-chosen", list(chosen_mm), chosen_px, self.scheme.alarm)

    def show_label(self, place_mm: FloatArray | None, text: str, name: str = "label") -> None:
        """Write a text at a point.

        Parameters
        ----------
        place_mm : (3,) float64
            Insole frame; None removes the text.
        text
            Usually a measure.
        name
            Name of the actor, for several labels at a time.
        """
        words = f"  {text}  "
        places = [] if place_mm is None else [place_mm]
        self._show_texts(name, places, [words] * len(places), LABEL_PX, boxed=True)
        self._labels.pop(name, None)
        if place_mm is not None:
            self._labels[name] = place_mm, words
        self._write_directions(self._look)
        self._show_contour_labels()

    def show_directions(self, side: Side | None, bounds_mm: FloatArray | None) -> None:
        """Write the anatomical directions around a box.

        Parameters
        ----------
        side
            Side of the foot; None removes the directions.
        bounds_mm : (2, 3) float64
            The box, insole frame; None removes the directions.
        """
        self._directions = ([], [])
        if side is not None and bounds_mm is not None:
            self._directions = direction_words(side, bounds_mm)
        self._write_directions(self._look)

    def show_plane(self, plane: ReferencePlane | None, size_mm: float) -> None:
        """Show the reference plane as a translucent square.

        Parameters
        ----------
        plane
            The plane; None removes it.
        size_mm
            Length of the square's sides.
        """
        self._remove("plane")
        if plane is None:
            return
        sheet = pv.Plane(
            center=plane.origin_mm,
            direction=plane.rotation @ np.array([0.0, 0.0, 1.0]),
            i_size=size_mm,
            j_size=size_mm,
        )
        self._add(
            sheet,
            name="plane",
            color=self.scheme.accent,
            opacity=0.35,
            lighting=False,
            show_edges=False,
        )

    def aim(self, look: ViewTransform) -> None:
        """Set the camera."""
        camera = self._plotter.camera
        eye = look.focal_mm + look.back * EYE_DISTANCE_MM
        for name, wanted in (
            ("focal_point", tuple(look.focal_mm.tolist())),
            ("position", tuple(eye.tolist())),
            ("up", tuple(look.up.tolist())),
            ("parallel_scale", look.height_mm / 2),
        ):
            if getattr(camera, name) != wanted:  # what is set anew costs, even if it is the same
                setattr(camera, name, wanted)
        camera.clipping_range = (1.0, 2 * EYE_DISTANCE_MM)
        self._look = look
        self._size_handles(look)
        self._write_directions(look)
        self._place_names(look)
        self._show_contour_labels()

    def _size_handles(self, look: ViewTransform) -> None:
        """Draw handles that lie near each other smaller."""
        share = 1.0
        if len(self._handles) > 1:
            at_px = look.pixels_of(np.array([handle.position_mm for handle in self._handles]))
            apart_px = np.linalg.norm(at_px[:, None] - at_px, axis=2)
            np.fill_diagonal(apart_px, np.inf)
            nearest_px = float(np.median(apart_px.min(axis=1)))
            share = float(
                np.clip(HANDLE_SHARE * nearest_px / HANDLE_PX["size"], LEAST_HANDLES, 1.0)
            )
        for kind, size_px in HANDLE_PX.items():
            for name, part in (("rim", share), ("handles", share * UNRIMMED)):
                actor = self._actors.get(f"{name}-{kind}")
                if actor is not None:
                    actor.prop.point_size = size_px * part * self._ratio

    def _write_directions(self, look: ViewTransform | None) -> None:
        """Write the directions that can be told in this view, whole and beside the thing."""
        places, words = np.array(self._directions[0]).reshape(-1, 3), self._directions[1]
        if look is not None and words:
            kept, gaps = is_across_view(places, look), np.repeat(WORD_GAP_MM, 2)
            places = moved_clear(places, _half_sizes_px(words, DIRECTION_PX), gaps, look)[kept]
            words = [word for word, is_kept in zip(words, kept, strict=True) if is_kept]
            half = _half_sizes_px(words, DIRECTION_PX)
            places = moved_off(
                moved_into_image(places, half, look), half, self._label_boxes(look), look
            )
        if words == self._written[1] and np.array_equal(places, self._written[0]):
            return
        self._written = (places, words)
        self._show_texts("directions", places, words, DIRECTION_PX, centred=True)

    def _place_names(self, look: ViewTransform) -> None:
        """Lay out the names of the key points clear of the anatomical directions."""
        places, words = self._written
        middle, half = look.pixels_of(places), _half_sizes_px(words, DIRECTION_PX)
        leaders = self._tags.place(look, np.hstack([middle - half, middle + half]))
        self.show_lines("name-leaders", leaders, self.scheme.text, 1.0)

    def _add(self, drawn: pv.PolyData, name: str, **look: Any) -> Any:
        """Draw something under a name, in place of what had it, and return its actor."""
        actor = self._plotter.add_mesh(drawn, name=name, reset_camera=False, render=False, **look)
        self._actors[name] = actor
        return actor

    def _remove(self, name: str) -> None:
        """Remove what is drawn under a name, if anything is."""
        actor = self._actors.pop(name, None)
        if actor is not None:
            self._plotter.remove_actor(actor, render=False)

    def _limit_to(self, limits: tuple[float, float]) -> None:
        """Give the colours of the surface these limits, which are most often those it has."""
        mapper = self._actors["surface"].mapper
        if mapper.scalar_range != limits:
            mapper.scalar_range = limits

    def _show_dots(self, name: str, places: Sequence[Any], size: float, color: str) -> None:
        self._show_in_front(
            name,
            np.array(places, dtype=float).reshape(-1, 3),
            (),
            color=color,
            point_size=size * self._ratio,
            render_points_as_spheres=True,
        )

    def _show_in_front(
        self, name: str, points: FloatArray, line_lengths: tuple[int, ...], **look: Any
    ) -> None:
        """Draw points, or polylines of these lengths through them, never hidden by a surface."""
        shape = (len(points), line_lengths, tuple(look.items()))
        if self._shapes.get(name) == shape:
            if len(points):
                self._in_front[name].points = points
            return
        self._shapes[name] = shape
        self._in_front.pop(name, None)
        self._remove(name)
        if len(points) == 0:
            return
        drawn = pv.PolyData(points)
        if line_lengths:
            drawn = pv.PolyData(points, lines=_line_cells(line_lengths))
        actor = self._add(drawn, name=name, lighting=False, **look)
        self._in_front[name] = actor.mapper.dataset
        # Drawn in front of any surface: handles must never be hidden by the foot.
        actor.mapper.SetResolveCoincidentTopologyToPolygonOffset()
        actor.mapper.SetRelativeCoincidentTopologyLineOffsetParameters(0, -66000)
        actor.mapper.SetRelativeCoincidentTopologyPointOffsetParameter(-66000)

    def _show_texts(
        self,
        name: str,
        places: Sequence[Any] | FloatArray,
        words: list[str],
        size: int,
        *,
        centred: bool = False,
        boxed: bool = False,
        colors: tuple[str, str] | None = None,
    ) -> None:
        if not words and name not in self._texts:
            return
        self._remove(name)
        self._texts.pop(name, None)
        if not words:
            return
        self._texts[name] = partial(
            self._show_texts, name, places, words, size, centred=centred, boxed=boxed, colors=colors
        )
        text_color, ground = colors or (self.scheme.text, self.scheme.bottom)
        self._actors[name] = self._plotter.add_point_labels(
            np.array(places, dtype=float),
            words,
            name=name,
            font_size=size,
            text_color=text_color,
            shape=None,
            # The text's own background: the label's shape does not follow its justification.
            background_color=ground if boxed else None,
            background_opacity=0.8 if boxed else 0.0,
            show_points=False,
            always_visible=True,
            reset_camera=False,
            render=False,
            justification_horizontal="center" if centred else "left",
            justification_vertical="center",
        )


def surface_look(
    surface: pv.PolyData, mesh: TriangleMesh, coloring: Coloring | None
) -> dict[str, Any]:
    """Return how a plotter shows a surface, and put the values of its colours into it.

    Parameters
    ----------
    surface
        Of the mesh.
    coloring
        By default the mesh's own colours, or those of the material.
    """
    if coloring is not None and coloring.painted is not None:
        surface.point_data["painted"] = coloring.painted
        return {"scalars": "painted", "rgb": True, "ambient": 0.55, "diffuse": 0.5}
    if coloring is not None:
        surface.point_data["values"] = coloring.values
        return {
            "scalars": "values",
            "cmap": coloring.color_map,
            "clim": coloring.limits,
            "nan_color": MISSING,
            "show_scalar_bar": False,
            "ambient": 0.35,
            "diffuse": 0.7,
        }
    if mesh.colors is not None:
        return {"scalars": "colors", "rgb": True, "ambient": 0.55, "diffuse": 0.5}
    return {"color": MATERIAL, "ambient": 0.15, "diffuse": 0.85}


def _kind(coloring: Coloring | None) -> tuple[str, bool]:
    """Return what has to be the same for colours to be exchanged without a new actor."""
    return ("", False) if coloring is None else (coloring.title, coloring.painted is not None)


def _half_sizes_px(words: Sequence[str], size_px: int) -> FloatArray:
    """Return half the widths and heights (n, 2) of words in a size of type, about.

    Of words in several lines, those of the longest line and of all.
    """
    lines = [word.split("\n") for word in words]
    sizes = [(0.3 * size_px * max(map(len, each)), 0.7 * size_px * len(each)) for each in lines]
    return np.array(sizes, dtype=float).reshape(-1, 2)


def direction_words(side: Side, bounds_mm: FloatArray) -> tuple[list[FloatArray], list[str]]:
    """Return the anatomical directions around a box.

    Parameters
    ----------
    side
        Side of the foot.
    bounds_mm : (2, 3) float64
        The box, insole frame.

    Returns
    -------
    places : list of (3,) float64
        Positions outside the box, mm.
    words : list of str
        The translated directions.
    """
    low, high = bounds_mm
    middle = (low + high) / 2
    medial, lateral = (high, low) if side is Side.LEFT else (low, high)
    sign = side.medial_sign
    places = [
        np.array([medial[0] + sign * WORD_GAP_MM[0], middle[1], low[2]]),
        np.array([lateral[0] - sign * WORD_GAP_MM[0], middle[1], low[2]]),
        np.array([middle[0], low[1] - WORD_GAP_MM[1], low[2]]),
        np.array([middle[0], high[1] + WORD_GAP_MM[1], low[2]]),
    ]
    return places, [tr("Medial"), tr("Lateral"), tr("Heel"), tr("Toes")]


def _line_cells(lengths: tuple[int, ...]) -> IndexArray:
    """Return VTK's cell array of polylines through consecutive points: count, indices, count, …"""
    starts = np.cumsum((0, *lengths[:-1]))
    return np.concatenate(
        [
            np.r_[length, np.arange(start, start + length)]
            for start, length in zip(starts, lengths, strict=True)
        ]
    ).astype(np.int32)


def polydata(mesh: TriangleMesh) -> pv.PolyData:
    """Return a mesh with its normals and colours as pyvista data."""
    surface = pv.PolyData.from_regular_faces(
        np.ascontiguousarray(mesh.vertices, dtype=np.float32), mesh.triangles
    )
    surface.point_data["Normals"] = mesh.vertex_normals.astype(np.float32)
    surface.point_data.active_normals_name = "Normals"
    if mesh.colors is not None:
        surface.point_data["colors"] = mesh.colors
    return surface
