from __future__ import annotations

import cv2
import numpy as np
import pytest

from insole_core.geometry.arrays import ByteArray
from insole_core.reconstruct.markers.blobs import BlobLimits, blueness, find_blobs, sharpened

BLUE, DIM_BLUE, SKIN = (20, 40, 150), (30, 60, 120), (220, 170, 150)
MARKERS = ((100, 80), (300, 90), (120, 400), (500, 300))


def picture(*rectangles: tuple[int, int, int, int, tuple[int, int, int]]) -> ByteArray:
    """Rectangles (u, v, width, height, colour) on dark grey."""
    image = np.full((480, 640, 3), 28, dtype=np.uint8)
    for u, v, width, height, color in rectangles:
        image[v : v + height, u : u + width] = color
    return image


def with_markers(*more: tuple[int, int, int, int, tuple[int, int, int]]) -> ByteArray:
    return picture(*more, *((u, v, 11, 13, BLUE) for u, v in MARKERS))


def centers_of_markers() -> list[tuple[float, float]]:
    return [(u + 5.0, v + 6.0) for u, v in MARKERS]


def check_only_markers(image: ByteArray) -> None:
    blobs = find_blobs(image)
    assert sorted(map(tuple, np.round(blobs.centroids, 3).tolist())) == sorted(centers_of_markers())
    assert blobs.areas.tolist() == [143.0] * 4
    assert [int((blobs.labels == i).sum()) for i in range(4)] == [143] * 4


def test_blueness_is_what_blue_has_over_the_others() -> None:
    colors = np.array([[BLUE, SKIN, (0, 0, 255), (255, 255, 255)]], dtype=np.uint8)
    assert blueness(colors).tolist() == [[110, 0, 255, 0]]


def test_finds_markers_and_their_centres() -> None:
    check_only_markers(with_markers((200, 150, 100, 200, SKIN)))


@pytest.mark.parametrize(
    "clutter",
    [
        (0, 440, 300, 40, DIM_BLUE),  # a cloth
        (200, 200, 120, 4, BLUE),  # a pen
        (320, 300, 3, 3, BLUE),  # a speck
    ],
)
def test_blue_things_that_cannot_be_markers_are_left_out(
    clutter: tuple[int, int, int, int, tuple[int, int, int]],
) -> None:
    check_only_markers(with_markers(clutter))


def test_a_marker_in_front_of_a_blue_cloth_comes_apart_from_it() -> None:
    check_only_markers(with_markers((60, 380, 200, 90, DIM_BLUE)))


def test_exposure_does_not_matter() -> None:
    check_only_markers((with_markers() * 0.25).astype(np.uint8))
    check_only_markers(np.minimum(with_markers().astype(int) + 90, 255).astype(np.uint8))


def test_centroids_are_finer_than_a_pixel() -> None:
    image = with_markers()
    image[80:93, 111] = np.array([24, 34, 89])  # half covered column to the right
    u = find_blobs(image).centroids[:, 0].min()
    assert 105.2 < u < 105.5


def test_nothing_blue_gives_nothing() -> None:
    assert len(find_blobs(picture((200, 150, 100, 200, SKIN)))) == 0
    assert len(find_blobs(np.zeros((480, 640, 3), np.uint8))) == 0


def test_only_the_largest_are_kept() -> None:
    image = picture(*((40 * i + 10, 50, 6 + i, 6 + i, BLUE) for i in range(10)))
    blobs = find_blobs(image, BlobLimits(most=3))
    assert blobs.areas.tolist() == [169.0, 196.0, 225.0]
    assert set(np.unique(blobs.labels)) == {-1, 0, 1, 2}


def seen_by_areas(left: float, upper: float, size: float) -> ByteArray:
    """A blue square on dark grey, blurred a little, as a camera integrates it over its pixels."""
    finer = 20
    across, down = (
        (np.arange(40 * finer) >= finer * low) & (np.arange(40 * finer) < finer * (low + size))
        for low in (left, upper)
    )
    shares = (down[:, None] & across).reshape(40, finer, 40, finer).mean((1, 3))
    image = np.zeros((480, 640))
    image[:40, :40] = shares
    share = cv2.GaussianBlur(image, (0, 0), 0.6)[..., None]
    return np.asarray(np.rint(28 + share * (np.array(BLUE) - 28)), dtype=np.uint8)


@pytest.mark.parametrize("size", [10.0, 19.7])
def test_centres_do_not_depend_on_how_faces_lie_to_the_pixels(size: float) -> None:
    misses = []
    for left, upper in np.random.default_rng(0).integers(180, 220, (20, 2)) / 20:
        image = seen_by_areas(left, upper, size)
        (center,) = sharpened(image, find_blobs(image)).centroids
        misses.append(center - (np.array([left, upper]) + size / 2 - 0.5))
    assert np.abs(misses).max() < 0.06


def test_a_face_beside_the_border_of_the_picture_keeps_its_centre() -> None:
    image = seen_by_areas(10.0, 10.0, 12.0)[8:, 7:]
    (center,) = sharpened(image, find_blobs(image)).centroids
    assert center == pytest.approx((8.5, 7.5), abs=0.05)
