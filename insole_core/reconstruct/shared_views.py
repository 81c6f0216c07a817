"""The views of a capture of both feet, measured and placed once for the two."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid
from insole_core.reconstruct.markers.marker_observation import Registration
from insole_core.reconstruct.poses.pose_quality import PoseRefusedError, RegistrationLimits
from insole_core.reconstruct.views.measured_view import MeasuredView
from insole_core.recording.hand_edits import ViewEdits
from insole_core.recording.session import ReferenceSystem, View

Register = Callable[[MeasuredView, ViewEdits], Registration]
"""Finds the pose of a view; raises a `ReconstructionError` when it finds none."""


class SharedViews:
    """Averages the frames of each view once, and finds its pose from all markers.

    The measurement keeps the pose for the other foot.

    Parameters
    ----------
    system
        For both feet.
    limits
        Beyond which the pose of a view is refused.
    measure
        Averages the frames of a view.
    """

    def __init__(
        self,
        system: ReferenceSystem,
        limits: RegistrationLimits,
        measure: Callable[[View], MeasuredView],
    ) -> None:
        self._system = system
        self._limits = limits
        self._measure = measure
        self._measured: dict[str, MeasuredView] = {}

    def measure(self, view: View) -> MeasuredView:
        """Return the measurement of a view.

        Raises
        ------
        ReconstructionError
            When the view has no usable measurement.
        """
        if view.name not in self._measured:
            self._measured[view.name] = self._measure(view)
        return self._measured[view.name]

    def around(self, side: Side) -> Register:
        """Return what finds poses in the own reference frame of one of the feet."""
        place = self._system.place(side)
        common2foot = rigid(np.eye(3), -np.array(place.origin_mm))
        box = place.volume_of_interest
        middle = (np.array(box.min_mm) + box.max_mm) / 2 + place.origin_mm

        def register(measured: MeasuredView, edits: ViewEdits) -> Registration:
            try:
                found = measured.register(self._system, self._limits, edits)
            except PoseRefusedError as error:
                moved = error.registration.moved(common2foot, middle)
                raise PoseRefusedError(error.message, moved) from error
            return found.moved(common2foot, middle)

        return register
