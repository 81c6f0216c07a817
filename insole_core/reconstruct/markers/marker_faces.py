"""How far behind its face the centre of a marker seen at an angle appears."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import inverse, transform
from insole_core.sensing.pinhole_camera import PinholeCamera

_LEAST_TANGENT = 0.25
_LEAST_OBLIQUE = 6
"""The width of a single marker gives the depth of its flank to a third of a millimetre only."""
_DEEPEST_MM = 8.0
_ALONG_AXIS = float(np.cos(np.radians(25)))
"""Blocks of different heights tilt the plane of their centres by up to this angle."""


def apparent_centers(
    markers: FloatArray, spreads: FloatArray, camera: PinholeCamera, reference2color: FloatArray
) -> FloatArray:
    """Compute the points that appear as the centres of blobs, on the faces or a little behind.

    A marker is a block: seen at an angle t to its normal, it shows, beside its face, a strip of its
    coloured flank of height h, so that the blob is wider by h tan t in the direction of the slant
    and its centre is shifted by half of that. This is where a point h/2 behind the face is seen,
    whatever the angle. The width across the slant is that of the face alone.

    Parameters
    ----------
    markers : (n, 3) float64, mm, reference frame
        Centres of the faces, all of which have the same normal.
    spreads : (n, 2, 2) float64, px²
        Covariance of the pixels of each blob.
    camera
        The colour camera.
    reference2color : (4, 4) float64, mm

    Returns
    -------
    (n, 3) float64, mm, reference frame
        The centres of the faces themselves when too few are seen at an angle; the shift is then
        negligible.
    """
    towards = inverse(reference2color)[:3, 3] - markers
    normal = _outward(markers, towards)
    height = towards @ normal
    aside = towards - height[:, None] * normal
    tangent = np.linalg.norm(aside, axis=1) / np.maximum(height, 1e-9)
    oblique = (tangent > _LEAST_TANGENT) & (height > 0)
    if oblique.sum() < _LEAST_OBLIQUE:
        return markers
    along = aside[oblique] / np.linalg.norm(aside[oblique], axis=1, keepdims=True)
    across = np.cross(normal, along)
    width = _widths_mm(
        markers[oblique], np.stack([along, across], 1), spreads[oblique], camera, reference2color
    )
    recess = (width[:, 0] - width[:, 1]) / (2 * tangent[oblique])
    return np.asarray(markers - np.clip(np.median(recess), 0, _DEEPEST_MM) * normal)


def _outward(markers: FloatArray, towards: FloatArray) -> FloatArray:
    """Return the common normal (3,) of the faces, as a rule an axis of the reference frame.

    The centres (n, 3) lie only roughly in one plane, and in a single view the effect of a tilted
    normal on the widths cannot be distinguished from that of a flank.
    """
    normal = np.linalg.svd(markers - markers.mean(0))[2][2]
    main = int(np.abs(normal).argmax())
    if np.abs(normal[main]) > _ALONG_AXIS:
        normal = np.eye(3)[main]
    return np.asarray(normal * np.sign(towards.mean(0) @ normal))


def _widths_mm(
    markers: FloatArray,
    axes: FloatArray,
    spreads: FloatArray,
    camera: PinholeCamera,
    reference2color: FloatArray,
) -> FloatArray:
    """Compute the widths (n, 2), mm, of blobs along two axes (n, 2, 3) in the plane of the face.

    A uniform square has the variance width² / 12 in every direction.
    """
    at = camera.project(transform(reference2color, markers))
    steps = [camera.project(transform(reference2color, markers + axes[:, i])) for i in (0, 1)]
    pixels_per_mm = np.stack([step - at for step in steps], axis=-1)
    back = np.linalg.inv(pixels_per_mm)
    in_plane = back @ spreads @ np.swapaxes(back, 1, 2)
    return np.asarray(np.sqrt(12 * np.diagonal(in_plane, axis1=1, axis2=2)))
