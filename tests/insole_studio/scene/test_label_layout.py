"""Names in a picture: none on another, none outside, each near its dot."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from insole_studio.scene.name_tags import (
    GAP_PX,
    leader_ends,
    moved_clear,
    moved_into_image,
    moved_off,
    name_boxes,
)
from insole_studio.scene.view_camera import ViewTransform

ROOM = (500, 400)
NOTHING = np.zeros((0, 4))
PLACES = st.lists(
    st.tuples(st.floats(100, 400), st.floats(100, 300), st.floats(30, 110)), min_size=1, max_size=14
)


def overlapping(a: np.ndarray, b: np.ndarray) -> bool:
    return bool((a[:2] < b[2:]).all() and (b[:2] < a[2:]).all())


@given(PLACES)
def test_no_name_stands_on_another_or_leaves_the_picture(
    places: list[tuple[float, float, float]],
) -> None:
    anchors = np.array(places)[:, :2]
    sizes = np.column_stack([np.array(places)[:, 2], np.full(len(places), 16.0)])
    boxes = name_boxes(anchors, sizes, NOTHING, ROOM)
    np.testing.assert_allclose(boxes[:, 2:] - boxes[:, :2], sizes)
    pairs = [(i, j) for i in range(len(boxes)) for j in range(i)]
    assert not any(overlapping(boxes[i], boxes[j]) for i, j in pairs)
    assert (boxes[:, :2] >= 0).all()
    assert (boxes[:, 2:] <= ROOM).all()


def test_a_lone_name_stands_right_of_its_dot() -> None:
    (box,) = boxes = name_boxes(np.array([[200.0, 150.0]]), np.array([[60.0, 16.0]]), NOTHING, ROOM)
    assert box.tolist() == [200 + GAP_PX, 142, 260 + GAP_PX, 158]
    assert np.isnan(leader_ends(np.array([[200.0, 150.0]]), boxes)).all()


def test_at_the_right_border_it_stands_left() -> None:
    (box,) = name_boxes(np.array([[480.0, 150.0]]), np.array([[60.0, 16.0]]), NOTHING, ROOM)
    assert box[2] == 480 - GAP_PX


def test_words_that_stand_there_are_kept_clear_and_a_line_leads_to_the_name() -> None:
    anchor, size = np.array([[200.0, 150.0]]), np.array([[60.0, 16.0]])
    band = np.array([[100.0, 130.0, 300.0, 170.0]])
    boxes = name_boxes(anchor, size, band, ROOM)
    assert not overlapping(boxes[0], band[0])
    (end,) = leader_ends(anchor, boxes)
    assert end[1] == boxes[0, 1::2].mean()
    assert boxes[0, 0] <= end[0] <= boxes[0, 2]


def test_where_there_is_no_room_the_name_is_still_shown() -> None:
    everywhere = np.array([[-1e3, -1e3, 1e3, 1e3]])
    boxes = name_boxes(np.array([[200.0, 150.0]]), np.array([[60.0, 16.0]]), everywhere, ROOM)
    assert boxes[0, 0] == 200 + GAP_PX


def test_a_word_cut_by_the_border_is_moved_until_it_is_whole() -> None:
    right, up, back = np.eye(3)
    look = ViewTransform(right, up, back, np.zeros(3), 200.0, ROOM)  # half a millimetre a pixel
    half = np.array([[20.0, 8.0]] * 3)
    cut, whole, outside = [120.0, 98.0, 5.0], [0.0, 10.0, 5.0], [-180.0, 0.0, 5.0]
    moved = moved_into_image(np.array([cut, whole, outside]), half, look)
    np.testing.assert_allclose(look.pixels_of(moved)[0], [480.0, 8.0])
    np.testing.assert_array_equal(moved[1:], [whole, outside])


@pytest.mark.parametrize("height_mm", [200.0, 800.0])
def test_words_beside_a_thing_never_touch_it(height_mm: float) -> None:
    right, up, back = np.eye(3)
    look = ViewTransform(right, up, back, np.zeros(3), height_mm, ROOM)
    edges = np.array([[-40.0, 0.0, 0.0], [40.0, 0.0, 0.0], [0.0, -120.0, 0.0], [0.0, 120.0, 0.0]])
    gaps, half = np.array([26.0, 26.0, 22.0, 22.0]), np.array([[30.0, 9.0]] * 4)
    outwards = edges / np.linalg.norm(edges, axis=1, keepdims=True)
    middles = edges + gaps[:, None] * outwards
    moved = moved_clear(middles, half, gaps, look)
    away = np.abs(look.pixels_of(moved) - look.pixels_of(edges))
    assert (away >= half).any(axis=1).all()
    if height_mm == 200.0:
        np.testing.assert_array_equal(moved, middles)


def test_a_word_goes_out_of_the_way_of_a_label_by_the_shorter_way() -> None:
    right, up, back = np.eye(3)
    look = ViewTransform(right, up, back, np.zeros(3), 200.0, ROOM)
    words, half = np.array([[0.0, 0.0, 0.0], [80.0, 0.0, 0.0]]), np.array([[20.0, 6.0]] * 2)
    (middle, _) = look.pixels_of(words)
    x, y = middle
    label = np.array([[x - 10.0, y - 1.0, x + 30.0, y + 15.0]])
    moved = look.pixels_of(moved_off(words, half, label, look))
    assert moved[0][1] + 6 <= label[0, 1]
    assert moved[0][0] == pytest.approx(middle[0])
    np.testing.assert_allclose(moved[1], look.pixels_of(words)[1])
