"""The painter on an off-screen plotter, looked at pixel by pixel."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import pyvista as pv

from insole_core.cases.case_record import ReferencePlane
from insole_core.geometry.side import Side
from insole_studio.scene.coloring import Coloring, ContourLines
from insole_studio.scene.guide_lines import NameLabel
from insole_studio.scene.painter import Painter, direction_words
from insole_studio.scene.pointer import Handle, MarkedPoint
from insole_studio.scene.secondary_mesh import SecondaryMesh
from insole_studio.scene.view_camera import Preset, Subject, ViewCamera, fitted, look

SIZE = (300, 400)


@pytest.fixture
def plotter() -> Iterator[Any]:
    plotter = pv.Plotter(off_screen=True, window_size=list(SIZE))
    yield plotter
    plotter.close()


@pytest.fixture
def painter(plotter: Any) -> Painter:
    return Painter(plotter)


def aim(painter: Painter, mesh: Any) -> Any:
    box = np.stack([mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)])
    seen = look(fitted(ViewCamera(Preset.PLANTAR), box, SIZE), Subject.FOOT, Side.LEFT, SIZE)
    painter.aim(seen)
    return seen


def pixels(plotter: Any) -> Any:
    plotter.render()
    return plotter.screenshot(return_img=True).astype(int)


def test_marks_and_words_follow_the_theme(painter: Painter, plotter: Any, make_foot: Any) -> None:
    aim(painter, make_foot(Side.LEFT).mesh)
    place = np.array([0.0, 120.0, 0.0])
    painter.show_lines("selected", [np.stack([place, place + 40.0])], painter.scheme.accent, 3.0)
    painter.show_label(place, "12.8 mm")
    light = plotter.actors["selected"].prop.color
    painter.set_dark(True)
    dark = plotter.actors["selected"].prop.color
    assert (light, dark) == (pv.Color("#1668b8"), pv.Color("#3a8ee0"))
    after = pixels(plotter)
    assert after[5, 5].max() < 90
    assert (after.min(axis=2) > 200).any()  # light words


def test_words_written_at_once_are_as_large_as_later_ones(plotter: Any, make_foot: Any) -> None:
    """On a screen of twice the scale, where the widget tells VTK so only when it has its size."""
    heights = []
    for ratio in (1.0, 2.0):
        painter = Painter(plotter, pixel_ratio=ratio)
        aim(painter, make_foot(Side.LEFT).mesh)
        painter.show_label(np.array([0.0, 120.0, 0.0]), "128")
        plotter.render_window.SetDPI(round(72 * ratio))  # as the widget does
        rows = (pixels(plotter).max(axis=2) < 90).any(axis=1)
        heights.append(int(rows.sum()))
        painter.clear()
    assert heights[1] == pytest.approx(2 * heights[0], abs=3)


def test_the_foot_appears_in_its_own_colours(
    painter: Painter, plotter: Any, make_foot: Any
) -> None:
    mesh = make_foot(Side.LEFT).mesh
    seen = aim(painter, mesh)
    painter.show_surface(mesh)
    image = pixels(plotter)
    x, y = seen.pixels_of(np.array([-20.0, 200.0, 0.0]))[0].astype(int)
    red, green, blue = image[y, x]
    assert red > green > blue
    assert red - blue > 40
    beside = image[5, 5]
    assert np.ptp(beside) < 12


def test_a_handle_is_where_the_camera_says_and_in_front(
    painter: Painter, plotter: Any, make_foot: Any
) -> None:
    mesh = make_foot(Side.LEFT).mesh
    seen = aim(painter, mesh)
    painter.show_surface(mesh)
    inside = (10.0, 120.0, 30.0)
    painter.show_handles((Handle("move", inside, kind="move"),))
    x, y = seen.pixels_of(np.array(inside))[0].astype(int)
    red, _green, blue = pixels(plotter)[y, x]
    assert blue > red + 60


def test_a_moved_surface_keeps_its_triangles(
    painter: Painter, plotter: Any, make_foot: Any
) -> None:
    mesh = make_foot(Side.LEFT).mesh
    aim(painter, mesh)
    painter.show_surface(mesh)
    moved = mesh.transformed(np.eye(4))
    assert painter.move_surface(moved, moved.vertex_normals)
    flipped = mesh.flipped()
    assert not painter.move_surface(flipped, flipped.vertex_normals)


def test_a_moved_surface_takes_other_colours_and_keeps_those_it_has(
    painter: Painter, plotter: Any, make_foot: Any
) -> None:
    mesh = make_foot(Side.LEFT).mesh
    count = len(mesh.vertices)
    first, other = (
        Coloring(np.zeros(count), (0.0, 1.0), "Map", painted=np.full((count, 3), value, np.uint8))
        for value in (40, 200)
    )
    painter.show_surface(mesh, first)
    shown = plotter.actors["surface"].mapper.dataset
    times = []
    for coloring in (first, other, other, first):
        assert painter.move_surface(mesh, mesh.vertex_normals, None, coloring)
        array = shown.point_data["painted"]
        assert (np.asarray(array) == coloring.painted).all()
        times.append(array.VTKObject.GetMTime())
    assert times[1] > times[0]
    assert times[2] == times[1]  # nothing is handed over again
    assert times[3] > times[2]


def test_an_unseen_painter_moves_nothing(painter: Painter, make_foot: Any) -> None:
    mesh = make_foot(Side.LEFT).mesh
    assert not painter.move_surface(mesh, mesh.vertex_normals)


def test_a_map_runs_from_dark_to_light(painter: Painter, plotter: Any, make_foot: Any) -> None:
    mesh = make_foot(Side.LEFT).mesh
    seen = aim(painter, mesh)
    painter.show_surface(mesh, Coloring(mesh.vertices[:, 1], (0.0, 250.0), "Height"))
    image = pixels(plotter)
    low, high = (
        image[tuple(seen.pixels_of(np.array([-20.0, y, 0.0]))[0].astype(int)[::-1])]
        for y in (10.0, 240.0)
    )
    assert high.sum() > low.sum() + 100


def test_contour_lines_are_drawn_and_labelled_from_above_only(
    painter: Painter, plotter: Any, make_foot: Any
) -> None:
    mesh = make_foot(Side.LEFT).mesh.flipped()  # faces up, as a contact surface
    painter.show_surface(mesh)
    strong = np.array([[[-20.0, 120.0, 1.0], [20.0, 120.0, 1.0]]])
    place = np.array([30.0, 40.0, 1.0])
    lines = ContourLines(np.empty((0, 2, 3)), strong, ((place, "5"),))
    box = mesh.bounds_mm
    seen = look(fitted(ViewCamera(Preset.PLANTAR), box, SIZE), Subject.INSOLE, Side.LEFT, SIZE)
    painter.aim(seen)
    painter.show_contours(None)
    without = pixels(plotter)
    painter.show_contours(lines)
    changed = np.argwhere(np.abs(pixels(plotter) - without).sum(axis=2) > 60)[:, ::-1]
    from_line = np.abs(changed - seen.pixels_of(np.array([0.0, 120.0, 1.0]))[0])
    from_label = np.abs(changed - seen.pixels_of(place)[0])
    assert (from_line[:, 1] <= 2).sum() > 20
    assert (from_label.max(axis=1) < 20).sum() > 5
    assert ((from_line[:, 1] <= 2) | (from_label.max(axis=1) < 20)).all()
    labels = next(actor for name, actor in plotter.actors.items() if "contour-labels" in name)
    assert labels.visibility
    painter.aim(look(fitted(ViewCamera(Preset.MEDIAL), box, SIZE), Subject.INSOLE, Side.LEFT, SIZE))
    assert not labels.visibility


@pytest.fixture
def written(painter: Painter, plotter: Any, monkeypatch: pytest.MonkeyPatch) -> list[list[str]]:
    """What is written on the labels of contour lines, each time they are written."""
    found: list[list[str]] = []
    write = plotter.add_point_labels

    def watch(places: Any, words: list[str], *, name: str, **how: Any) -> None:
        if name == "contour-labels":
            found.append(words)
        write(places, words, name=name, **how)

    monkeypatch.setattr(plotter, "add_point_labels", watch)
    box = np.array([[-50.0, 0.0, 0.0], [50.0, 250.0, 20.0]])
    painter.aim(
        look(fitted(ViewCamera(Preset.PLANTAR), box, SIZE), Subject.INSOLE, Side.LEFT, SIZE)
    )
    places = {"5": (-30.0, 60.0, 5.0), "10": (0.0, 120.0, 10.0), "15": (30.0, 200.0, 15.0)}
    labels = tuple((np.array(place), text) for text, place in places.items())
    painter.show_contours(ContourLines(np.empty((0, 2, 3)), np.empty((0, 2, 3)), labels))
    assert found == [["5", "10", "15"]]
    return found


def test_a_contour_label_gives_way_to_a_handle(painter: Painter, written: list[list[str]]) -> None:
    painter.show_handles((Handle("move", (2.0, 122.0, 10.0), kind="move"),))
    assert written[-1] == ["5", "15"]
    painter.show_handles((Handle("front", (2.0, 128.0, 10.0), kind="size"),))
    assert written[-1] == ["5", "15"]
    painter.show_handles(())
    assert written[-1] == ["5", "10", "15"]


def test_a_contour_label_gives_way_to_a_measure_that_starts_left_of_it(
    painter: Painter, written: list[list[str]]
) -> None:
    painter.show_label(np.array([12.0, 200.0, 15.0]), "12.8 mm")
    assert written[-1] == ["5", "10"]
    painter.show_label(None, "")
    assert written[-1] == ["5", "10", "15"]


def test_contour_labels_that_stay_are_not_written_again(
    painter: Painter, written: list[list[str]]
) -> None:
    for y_mm in (10.0, 20.0, 30.0):
        painter.show_handles((Handle("move", (40.0, y_mm, 0.0), kind="move"),))
    assert len(written) == 1


def test_light_from_the_side_shades_a_slope(painter: Painter, plotter: Any, make_foot: Any) -> None:
    mesh = make_foot(Side.LEFT).mesh
    aim(painter, replace(mesh, colors=None))
    painter.show_surface(replace(mesh, colors=None))
    contrast = []
    for on in (False, True):
        painter.show_grazing_light(on)
        skin = pixels(plotter)[150:250, 100:200].sum(axis=2) / 3
        contrast.append(np.ptp(skin) / skin.mean())
    assert contrast[1] > 1.5 * contrast[0]


def test_what_has_no_value_is_grey(painter: Painter, plotter: Any, make_foot: Any) -> None:
    mesh = make_foot(Side.LEFT).mesh
    seen = aim(painter, mesh)
    painter.show_surface(mesh, Coloring(np.full(len(mesh.vertices), np.nan), (0.0, 1.0), "Height"))
    x, y = seen.pixels_of(np.array([-20.0, 200.0, 0.0]))[0].astype(int)
    assert np.ptp(pixels(plotter)[y, x]) < 12


def test_marks_appear_and_go(painter: Painter, plotter: Any, make_foot: Any) -> None:
    mesh = make_foot(Side.LEFT).mesh
    aim(painter, mesh)
    painter.show_surface(mesh)
    bare = pixels(plotter)
    box = np.stack([mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)])
    painter.show_key_points([MarkedPoint("Heel", (0.0, 20.0, 0.0))])
    painter.show_plane(ReferencePlane((0.0, 120.0, -20.0)), 100.0)
    painter.show_lines("outlines", [mesh.vertices[:40]], "red", 2.0)
    painter.show_directions(Side.LEFT, box)
    assert (pixels(plotter) != bare).any()
    painter.show_key_points([])
    painter.show_plane(None, 100.0)
    painter.show_lines("outlines", [], "red", 2.0)
    painter.show_directions(None, None)
    assert np.abs(pixels(plotter) - bare).max() <= 2


def test_key_points_and_the_names_of_two_feet_leave_each_other_alone(
    painter: Painter, plotter: Any, make_foot: Any
) -> None:
    aim(painter, make_foot(Side.LEFT).mesh)
    companion = SecondaryMesh(plotter)
    feet = [NameLabel("LEFT", np.array([-30.0, 120.0, 0.0]), "#1668b8")]
    points = [MarkedPoint("Heel", (0.0, 20.0, 0.0))]
    companion.show_names(feet)
    only_feet = pixels(plotter)
    painter.show_key_points(points)
    both = pixels(plotter)
    painter.show_key_points([])
    assert np.abs(pixels(plotter) - only_feet).max() <= 2
    painter.show_key_points(points)
    companion.show_names([])
    only_points = pixels(plotter)
    companion.show_names(feet)
    assert np.abs(pixels(plotter) - both).max() <= 2
    assert (only_points != both).any()
    companion.show_names([])
    assert np.abs(pixels(plotter) - only_points).max() <= 2


@pytest.mark.parametrize("side", list(Side))
def test_medial_is_written_on_the_side_of_the_big_toe(side: Side) -> None:
    box = np.array([[-40.0, 0.0, 0.0], [45.0, 250.0, 100.0]])
    places, words = direction_words(side, box)
    where = dict(zip(words, places, strict=True))
    assert np.sign(where["Medial"][0]) == side.medial_sign
    assert np.sign(where["Lateral"][0]) == -side.medial_sign
    assert where["Toes"][1] > 250 > where["Heel"][1]


@pytest.mark.parametrize(
    ("preset", "words"),
    [
        (Preset.PLANTAR, {"Medial", "Lateral", "Heel", "Toes"}),
        (Preset.MEDIAL, {"Heel", "Toes"}),
        (Preset.POSTERIOR, {"Medial", "Lateral"}),
    ],
)
def test_no_word_stands_before_or_behind_the_foot(
    painter: Painter,
    plotter: Any,
    preset: Preset,
    words: set[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    written: list[set[str]] = []
    monkeypatch.setattr(
        plotter, "add_point_labels", lambda _places, words, **_how: written.append(set(words))
    )
    painter.show_directions(Side.LEFT, np.array([[-40.0, 0.0, 0.0], [45.0, 250.0, 100.0]]))
    camera = ViewCamera(preset=preset, focal_mm=(0.0, 120.0, 30.0), height_mm=400.0)
    painter.aim(look(camera, Subject.FOOT, Side.LEFT, SIZE))
    assert written[-1] == words


def test_a_measure_beside_the_foot_does_not_cover_a_direction(
    painter: Painter, plotter: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    written: dict[str, Any] = {}

    def note(places: Any, words: Sequence[str], **_how: Any) -> None:
        written.update(zip((word.strip() for word in words), np.asarray(places), strict=True))

    monkeypatch.setattr(plotter, "add_point_labels", note)
    box = np.array([[-40.0, 0.0, 0.0], [45.0, 250.0, 100.0]])
    camera = ViewCamera(Preset.PLANTAR, focal_mm=(0.0, 120.0, 30.0), height_mm=400.0)
    seen = look(camera, Subject.FOOT, Side.LEFT, SIZE)
    painter.aim(seen)
    painter.show_directions(Side.LEFT, box)
    before = seen.pixels_of(written["Lateral"])[0]
    painter.show_label(written["Lateral"] - 5 * seen.right, "64.5 mm")
    assert abs(seen.pixels_of(written["Lateral"])[0][1] - before[1]) > 15
    assert abs(seen.pixels_of(written["Lateral"])[0][1] - before[1]) < 40
    painter.show_label(None, "")
    np.testing.assert_allclose(seen.pixels_of(written["Lateral"])[0], before)


def test_the_handles_of_a_small_pad_do_not_hide_it(painter: Painter, plotter: Any) -> None:
    angles = np.linspace(0, 2 * np.pi, 14, endpoint=False)
    for radius_mm, most in ((16.0, 0.25), (60.0, 0.15)):
        ring = [(radius_mm * np.cos(a), 125.0 + radius_mm * np.sin(a), 0.0) for a in angles]
        corners = [Handle(f"corner:{n}", place, kind="corner") for n, place in enumerate(ring)]
        painter.show_handles((Handle("move", (0.0, 125.0, 0.0), kind="move"), *corners))
        box = np.array([[-100.0, 0.0, 0.0], [100.0, 250.0, 20.0]])
        seen = look(fitted(ViewCamera(Preset.PLANTAR), box, SIZE), Subject.FOOT, Side.LEFT, SIZE)
        painter.aim(seen)
        red, _green, blue = np.moveaxis(pixels(plotter), -1, 0)
        x, y = np.meshgrid(np.arange(SIZE[0]), np.arange(SIZE[1]))
        middle = seen.pixels_of(np.array([0.0, 125.0, 0.0]))[0]
        in_pad = np.hypot(x - middle[0], y - middle[1]) < radius_mm / seen.mm_per_px
        is_handle = (blue > red + 60) | (np.minimum(red, blue) > 250)
        assert 0.0 < is_handle[in_pad].mean() < most
