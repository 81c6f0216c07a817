"""The pinhole camera with lens distortion (thesis appendix B; the model of OpenCV)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from insole_core.geometry.arrays import FloatArray

_UNDISTORT_STEPS = 20
_MOST_UNDISTORT_PX = 20.0
"""Far beyond what steps too few leave over: the iteration does not converge."""


@dataclass(frozen=True)
class PinholeCamera:
    """Intrinsic parameters of one camera. Pixel centres lie at integers, (u, v) = (column, row).

    Parameters
    ----------
    width, height
        Image size, px.
    fx, fy, cx, cy
        Focal lengths and principal point, px.
    distortion
        (k1, k2, p1, p2, k3), radial and tangential.
    skew
        Thesis (B.5), px; added to u per unit of normalised y.
    """

    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    distortion: tuple[float, float, float, float, float] = (0.0, 0.0, 0.0, 0.0, 0.0)
    skew: float = 0.0

    def distort(self, normalised: FloatArray) -> FloatArray:
        """Apply the lens distortion.

        Parameters
        ----------
        normalised : (..., 2) float64
            Undistorted coordinates (x/z, y/z).

        Returns
        -------
        (..., 2) float64
            Distorted normalised coordinates.
        """
        k1, k2, p1, p2, k3 = self.distortion
        x, y = normalised[..., 0], normalised[..., 1]
        r2 = x * x + y * y
        radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3))
        return np.stack(
            [
                x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
                y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y,
            ],
            axis=-1,
        )

    def project(self, points: FloatArray) -> FloatArray:
        """Project points onto the image, thesis (14), (15) with the lens of appendix B.

        Parameters
        ----------
        points : (..., 3) float64, mm, this camera's frame, z > 0

        Returns
        -------
        (..., 2) float64, px
        """
        bent = self.distort(points[..., :2] / points[..., 2:])
        x, y = bent[..., 0], bent[..., 1]
        return np.stack([self.fx * x + self.skew * y + self.cx, self.fy * y + self.cy], axis=-1)

    def normalised(self, pixels: FloatArray) -> FloatArray:
        """Undistort pixels, iteratively; inverse of `project` up to the depth.

        Parameters
        ----------
        pixels : (..., 2) float64, px

        Returns
        -------
        (..., 2) float64
            Normalised coordinates (x/z, y/z).
        """
        y = (pixels[..., 1] - self.cy) / self.fy
        x = (pixels[..., 0] - self.cx - self.skew * y) / self.fx
        bent = np.stack([x, y], axis=-1)
        if not any(self.distortion):
            return bent
        straight = bent
        for _ in range(_UNDISTORT_STEPS):
            straight = straight + bent - self.distort(straight)
        return straight

    @property
    def can_be_undistorted(self) -> bool:
        """Whether `normalised` is the inverse of the lens up to the middle of the picture's edges.

        No lens bends so strongly that it is not; a damaged or mistyped number does. The corners
        of a sensor that was calibrated from few boards may lie beyond.
        """
        right, lower = self.width - 1, self.height - 1
        u, v = np.array([(0, self.cy), (right, self.cy), (self.cx, 0), (self.cx, lower)], float).T
        with np.errstate(over="ignore", invalid="ignore"):
            rays = self.normalised(np.stack([u, v], axis=-1))
            bent = self.project(np.concatenate([rays, np.ones((*rays.shape[:-1], 1))], axis=-1))
            return bool(np.abs(bent - np.stack([u, v], axis=-1)).max() < _MOST_UNDISTORT_PX)

    def pixel_rays(self) -> FloatArray:
        """Return the normalised coordinates (height, width, 2) of all pixel centres, read-only."""
        return self._pixel_rays

    @cached_property
    def _pixel_rays(self) -> FloatArray:
        v, u = np.mgrid[: self.height, : self.width].astype(float)
        rays = self.normalised(np.stack([u, v], axis=-1))
        rays.setflags(write=False)
        return rays
