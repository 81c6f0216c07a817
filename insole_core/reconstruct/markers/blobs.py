"""Blue blobs in a colour image: the thesis's algorithm 3 without the region drawn by hand."""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np

from insole_core.geometry.arrays import ByteArray, FloatArray, IndexArray, IntArray


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
    labels : (height, width) int32
        Index of the blob that a pixel belongs to, -1 elsewhere.
    spreads : (n, 2, 2) float64, px², optional
        Covariance of the pixels that are at least half as blue as the blob's inside.
    fills : (n,) float64, optional
        Area divided by that of a square with the same covariance: the same constant below 1 for
        every face seen whole, less for one that is partly hidden or merges with another.
    """

    centroids: FloatArray
    areas: FloatArray
    labels: IndexArray
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
        return Blobs(features[:, :2], features[:, 2], labels)
    kept = np.sort(np.argsort(-features[:, 2], kind="stable")[:most])
    index = np.full(len(features) + 1, -1, dtype=np.int32)
    index[kept] = np.arange(len(kept))
    return Blobs(features[kept, :2], features[kept, 2], index[labels])


def sharpened(color: ByteArray, blobs: Blobs) -> Blobs:
    """Measure centre, spread and fill of every blob relative to its own blueness.

    A threshold common to the image includes the light that blur spreads into a marker's
    surroundings, more on one side than on the other, and strips of other markers behind it.
    Here the pixels of a face count fully from 0.85 of its own blueness on and not at all below
    0.65, so that its rim is placed evenly on all sides, to a fraction of a pixel. Its width is
    measured at half of its blueness, where blur does not change it.

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
    value = blue[v, u].astype(float)
    share = value / np.maximum(_upper_half_means(value, label, len(blobs)), 1)[label]
    inner, whole = (np.clip((share - low) / 0.2, 0, 1) for low in (0.65, 0.4))
    centers, _ = _moments(label, u, v, inner, len(blobs))
    _, spreads = _moments(label, u, v, whole, len(blobs))
    area = np.bincount(label, inner, minlength=len(blobs))
    square = 12 * np.sqrt(np.maximum(np.linalg.det(spreads), 1e-12))
    return replace(blobs, centroids=centers, spreads=spreads, fills=area / square)


def _moments(
    label: IndexArray, u: IntArray, v: IntArray, weight: FloatArray, count: int
) -> tuple[FloatArray, FloatArray]:
    """Compute weighted mean (count, 2) and covariance (count, 2, 2) of the pixels of every blob."""
    mass = np.maximum(np.bincount(label, weight, minlength=count), 1e-9)
    centers = np.stack(
        [np.bincount(label, weight * at, minlength=count) / mass for at in (u, v)], axis=1
    )
    du, dv = u - centers[label, 0], v - centers[label, 1]
    uu, uv, vv = (
        np.bincount(label, weight * product, minlength=count) / mass
        for product in (du * du, du * dv, dv * dv)
    )
    return centers, np.stack([uu, uv, uv, vv], axis=1).reshape(-1, 2, 2)


def _upper_half_means(values: FloatArray, group: IndexArray, count: int) -> FloatArray:
    """Return the mean of the values above their group's mean: the face without its rim."""
    size = np.maximum(np.bincount(group, minlength=count), 1)
    mean = np.bincount(group, values, minlength=count) / size
    upper = values >= mean[group]
    number = np.maximum(np.bincount(group[upper], minlength=count), 1)
    return np.asarray(np.bincount(group[upper], values[upper], minlength=count) / number)
