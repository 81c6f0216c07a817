"""What a marker seen aslant shows beside its face: how far behind the face its centre appears."""

from __future__ import annotations

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.transforms import inverse, transform
from insole_core.sensing.camera import Camera

_LEAST_TANGENT = 0.25
_DEEPEST_MM = 8.0


def apparent_centers(
    markers: FloatArray, spreads: FloatArray, camera: Camera, reference2color: FloatArray
) -> FloatArray:
    """Give the places that the centres of blobs show: those of the faces, or a little behind.

    A marker is a block: seen at an angle t to its normal, it shows, beside its face, a strip of its
    coloured flank of height h, so that the blob is wider by h tan t in the direction of the slant
    and its centre is half of that aside. That is where a point h/2 behind the face would be seen,
    whatever the angle. The width across the slant tells how wide the face alone would be.

    Parameters
    ----------
    markers : (n, 3) float64, mm, reference frame
        Centres of the faces; all look the same way.
    spreads : (n, 2, 2) float64, px²
        Covariance of the pixels of each blob.
    camera
    reference2color : (4, 4) float64, mm

    Returns
    -------
    (n, 3) float64, mm, reference frame; the faces themselves when the view looks too squarely at
    them to tell, and then it does not matter
    """
    towards = inverse(reference2color)[:3, 3] - markers
    normal = np.linalg.svd(markers - markers.mean(0))[2][2]
    normal = normal * np.sign(towards.mean(0) @ normal)
    height = towards @ normal
    aside = towards - height[:, None] * normal
    tangent = np.linalg.norm(aside, axis=1) / np.maximum(height, 1e-9)
    oblique = (tangent > _LEAST_TANGENT) & (height > 0)
    if oblique.sum() < 3:
        return markers
    along = aside[oblique] / np.linalg.norm(aside[oblique], axis=1, keepdims=True)
    across = np.cross(normal, along)
    width = _widths_mm(
        markers[oblique], np.stack([along, across], 1), spreads[oblique], camera, reference2color
    )
    recess = (width[:, 0] - width[:, 1]) / (2 * tangent[oblique])
    return np.asarray(markers - np.clip(np.median(recess), 0, _DEEPEST_MM) * normal)


def _widths_mm(
    markers: FloatArray,
    axes: FloatArray,
    spreads: FloatArray,
    camera: Camera,
    reference2color: FloatArray,
) -> FloatArray:
    """Widths (n, 2) of blobs along two axes (n, 2, 3) in the plane of the face.

    An even square has the variance width² / 12 in every direction.
    """
    at = camera.project(transform(reference2color, markers))
    steps = [camera.project(transform(reference2color, markers + axes[:, i])) for i in (0, 1)]
    pixels_per_mm = np.stack([step - at for step in steps], axis=-1)
    back = np.linalg.inv(pixels_per_mm)
    in_plane = back @ spreads @ np.swapaxes(back, 1, 2)
    return np.asarray(np.sqrt(12 * np.diagonal(in_plane, axis1=1, axis2=2)))
