"""Blue blobs in a colour image: the thesis's algorithm 3 without the region drawn by hand."""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np

from insole_core.geometry.arrays import ByteArray, FloatArray, IndexArray, IntArray, LabelArray

_FINER = 4
"""Steps per pixel between which a blob's rim is sought."""
_AROUND_PX = 4
"""What is looked at around a blob."""


@dataclass(frozen=True)
class BlobLimits:
    """Which blue components can be markers.

    Parameters
    ----------
    levels
        Thresholds, as shares of the strongest blue in the image. A component that cannot be a
        marker at one level is examined again at the next, where it may split.
    least_blue
        Smallest threshold (0 to 255); below it there is only noise, however dark the image.
    least_area_px
        Number of pixels.
    largest_width_share
        Widest marker as a share of the image width.
    largest_eccentricity
        0 is a disc, 1 a line; a square seen at 60 degrees has 0.87.
    most
        Number of blobs that are kept, the largest first.
    """

    levels: tuple[float, ...] = (0.4, 0.6, 0.8)
    least_blue: float = 12.0
    least_area_px: int = 16
    largest_width_share: float = 0.1
    largest_eccentricity: float = 0.92
    most: int = 40


@dataclass(frozen=True, eq=False)
class Blobs:
    """The marker candidates of one colour image.

    Parameters
    ----------
    centroids : (n, 2) float64, px, (u, v)
        Weighted with the blueness, so finer than a pixel; of the face after `sharpened`.
    areas : (n,) float64, px²
    labels : (height, width) int16
        Index of the blob that a pixel belongs to, -1 elsewhere.
    spreads : (n, 2, 2) float64, px², optional
        Covariance of the pixels that are at least half as blue as the blob's inside.
    fills : (n,) float64, optional
        Area divided by that of a square with the same covariance: the same constant below 1 for
        every face seen whole, less for one that is partly hidden or merges with another.
    """

    centroids: FloatArray
    areas: FloatArray
    labels: LabelArray
    spreads: FloatArray | None = None
    fills: FloatArray | None = None

    def __len__(self) -> int:
        return len(self.areas)


def blueness(color: ByteArray) -> ByteArray:
    """Compute I = B - max(R, G), thesis (24); negative values become 0.

    Parameters
    ----------
    color : (height, width, 3) uint8, RGB

    Returns
    -------
    (height, width) uint8
    """
    red, green, blue = cv2.split(np.ascontiguousarray(color))
    return np.asarray(cv2.subtract(blue, cv2.max(red, green)))


def find_blobs(color: ByteArray, limits: BlobLimits = BlobLimits()) -> Blobs:
    """Find the blue components that could be markers (thesis algorithm 3).

    Parameters
    ----------
    color : (height, width, 3) uint8, RGB
    limits

    Returns
    -------
    Blobs
        With centroids, areas and labels only; see `sharpened` for the rest.
    """
    blue = blueness(color)
    labels = np.full(blue.shape, -1, dtype=np.int32)
    found: list[FloatArray] = []
    strongest = _strongest(blue)
    for level in limits.levels:
        _add_blobs(blue, max(limits.least_blue, level * strongest), labels, found, limits)
    features = np.concatenate([np.empty((0, 3)), *found])
    return _largest(features, labels, limits.most)


def _strongest(blue: ByteArray) -> int:
    """Return the blueness that one pixel in ten thousand exceeds.

    These are fewer pixels than one marker has, and more than the defective ones.
    """
    brighter = np.cumsum(cv2.calcHist([blue], [0], None, [256], [0, 256]).ravel()[::-1])
    return 255 - int(np.argmax(brighter > blue.size / 10_000))


def _add_blobs(
    blue: ByteArray,
    threshold: float,
    labels: IndexArray,
    found: list[FloatArray],
    limits: BlobLimits,
) -> None:
    """Add the components above a threshold that look like markers and are not labelled yet."""
    mask = ((blue > threshold) & (labels < 0)).astype(np.uint8)
    # After a lower level little is left, so only its bounding box is searched.
    left, upper, width, height = cv2.boundingRect(mask)
    part = (slice(upper, upper + height), slice(left, left + width))
    mask = np.ascontiguousarray(mask[part])
    if not mask.size:
        return
    _, components, stats, _ = cv2.connectedComponentsWithStats(
        mask, connectivity=8, ltype=cv2.CV_32S
    )
    v, u = np.divmod(np.flatnonzero(mask), width)
    component = components[v, u]
    u, v = u + left, v + upper
    features, eccentricity = _features(component, u, v, blue[v, u].astype(float), len(stats))
    widest = np.maximum(stats[:, cv2.CC_STAT_WIDTH], stats[:, cv2.CC_STAT_HEIGHT])
    good = (features[:, 2] >= limits.least_area_px) & (eccentricity <= limits.largest_eccentricity)
    good &= widest <= limits.largest_width_share * blue.shape[1]
    good[0] = False
    index = np.full(len(stats), -1, dtype=np.int32)
    index[good] = sum(map(len, found)) + np.arange(good.sum())
    labels[v, u] = index[component]
    found.append(features[good])


def _features(
    component: IndexArray,
    u: IntArray,
    v: IntArray,
    weight: FloatArray,
    count: int,
) -> tuple[FloatArray, FloatArray]:
    """Compute centroid and area (count, 3), and eccentricity (count,), of every component."""

    def total(values: FloatArray) -> FloatArray:
        return np.asarray(np.bincount(component, values, minlength=count), dtype=np.float64)

    area = np.bincount(component, minlength=count).astype(float)
    mass = np.maximum(total(weight), 1e-9)
    center_u, center_v = total(weight * u) / mass, total(weight * v) / mass
    du, dv = u - center_u[component], v - center_v[component]
    uu, vv, uv = (total(weight * product) / mass for product in (du * du, dv * dv, du * dv))
    middle, half = (uu + vv) / 2, np.hypot((uu - vv) / 2, uv)
    # A pixel is a square: its own second moment keeps a one-pixel line from having no width.
    smallest, largest = middle - half + 1 / 12, middle + half + 1 / 12
    return np.stack([center_u, center_v, area], axis=1), np.sqrt(1 - smallest / largest)


def _largest(features: FloatArray, labels: IndexArray, most: int) -> Blobs:
    """Keep the largest blobs, thesis algorithm 3, step 7."""
    if len(features) <= most:
        return Blobs(features[:, :2], features[:, 2], labels.astype(np.int16))
    kept = np.sort(np.argsort(-features[:, 2], kind="stable")[:most])
    index = np.full(len(features) + 1, -1, dtype=np.int16)
    index[kept] = np.arange(len(kept))
    return Blobs(features[kept, :2], features[kept, 2], index[labels])


def sharpened(color: ByteArray, blobs: Blobs) -> Blobs:
    """Measure centre, spread and fill of every blob relative to its own blueness.

    A threshold common to the image includes the light that blur spreads into a marker's
    surroundings, more on one side than on the other, and strips of other markers behind it.
    Here the points of a face count fully from 0.85 of its own blueness on and not at all below
    0.65, so that its rim is placed evenly on all sides. Its width is measured at half of its
    blueness, where blur does not change it.

    The rim is narrower than a pixel: counted pixel by pixel, it would be up to half a pixel off,
    depending on how it lies to the rows and columns, in every frame alike (decision 0018). So it is
    sought in the picture between the pixels.

    Parameters
    ----------
    color : (height, width, 3) uint8, RGB
    blobs
        Found in `color`.

    Returns
    -------
    Blobs
        The same blobs with the centres of their faces, and with `spreads` and `fills`.
    """
    blue = blueness(color)
    v, u = np.nonzero(blobs.labels >= 0)
    label = blobs.labels[v, u]
    levels = _upper_half_means(blue[v, u].astype(float), label, len(blobs))
    centers, spreads, areas = (
        np.zeros((len(blobs), 2)),
        np.zeros((len(blobs), 2, 2)),
        np.zeros(len(blobs)),
    )
    corners = _bounding_corners(u, v, label, len(blobs))
    height, width = blue.shape
    for index, (left, upper, right, lower) in enumerate(corners.tolist()):
        rows = slice(max(upper - _AROUND_PX, 0), min(lower + _AROUND_PX + 1, height))
        columns = slice(max(left - _AROUND_PX, 0), min(right + _AROUND_PX + 1, width))
        share = _between_pixels(blue[rows, columns], blobs.labels[rows, columns], index)
        share /= max(levels[index], 1.0)
        inner, whole = (np.clip((share - low) / 0.2, 0, 1) for low in (0.65, 0.4))
        center, _, areas[index] = _moments(inner)
        centers[index] = center + np.array([columns.start, rows.start])
        spreads[index] = _moments(whole)[1]
    square = 12 * np.sqrt(np.maximum(np.linalg.det(spreads), 1e-12))
    return replace(blobs, centroids=centers, spreads=spreads, fills=areas / square)


def _bounding_corners(u: IntArray, v: IntArray, label: LabelArray, count: int) -> IntArray:
    """Return the least and largest u and v of every blob: (count, 4), left, upper, right, lower."""
    corners = np.tile(np.array([np.iinfo(np.int64).max] * 2 + [-1] * 2), (count, 1))
    for column, (extreme, at) in enumerate(
        [(np.minimum, u), (np.minimum, v), (np.maximum, u), (np.maximum, v)]
    ):
        extreme.at(corners[:, column], label, at)
    return corners


def _between_pixels(blue: ByteArray, labels: LabelArray, index: int) -> FloatArray:
    """Interpolate the blueness of one blob and of its rim; 0 away from it and in other blobs.

    Parameters
    ----------
    blue, labels : (height, width) uint8 and int16
        A part of the image around the blob.
    index
        Of the blob.

    Returns
    -------
    (height, width) times `_FINER`, float32
    """
    around = cv2.dilate((labels == index).astype(np.uint8), np.ones((5, 5), np.uint8))
    around[(labels >= 0) & (labels != index)] = 0
    size = (blue.shape[1] * _FINER, blue.shape[0] * _FINER)
    fine = cv2.resize(blue.astype(np.float32), size, interpolation=cv2.INTER_CUBIC)
    return np.asarray(fine * cv2.resize(around, size, interpolation=cv2.INTER_NEAREST))


def _moments(weight: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Compute mean (2,), covariance (2, 2), (u, v), and sum of weights between pixels, in pixels.

    Pixel centres are at integers.
    """
    across, down = weight.sum(0, dtype=float), weight.sum(1, dtype=float)
    mass = max(float(across.sum()), 1e-9)
    u, v = ((np.arange(len(sums)) + 0.5) / _FINER - 0.5 for sums in (across, down))
    center = np.array([across @ u, down @ v]) / mass
    du, dv = u - center[0], v - center[1]
    uv = dv @ weight @ du
    spread = np.array([[across @ du**2, uv], [uv, down @ dv**2]]) / mass
    return center, spread, mass / _FINER**2


def _upper_half_means(values: FloatArray, group: LabelArray, count: int) -> FloatArray:
    """Return the mean of the values above their group's mean: the face without its rim."""
    size = np.maximum(np.bincount(group, minlength=count), 1)
    mean = np.bincount(group, values, minlength=count) / size
    upper = values >= mean[group]
    number = np.maximum(np.bincount(group[upper], minlength=count), 1)
    return np.asarray(np.bincount(group[upper], values[upper], minlength=count) / number)
