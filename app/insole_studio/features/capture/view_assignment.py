"""Which sensor captures which view, and the plan request that follows."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import replace

from insole_core.geometry.side import BOTH, Sides
from insole_studio.acquisition.capture_plan import PlanRequest
from insole_studio.features.capture.rows import USUAL_VIEWS, VIEWS_OF_BOTH, CaptureOptions

_FURTHER_VIEWS = tuple(f"view_{number}" for number in range(4, 12))


class ViewAssignment:
    """Views by serial number, each of one sensor; that of a disconnected one stays until taken.

    Parameters
    ----------
    pairs
        View and serial number; of a sensor or a view that occurs twice the first pair counts.
    """

    def __init__(self, pairs: Iterable[tuple[str, str]]) -> None:
        self._views: dict[str, str] = {}
        self.take(pairs)

    def take(self, pairs: Iterable[tuple[str, str]]) -> None:
        """Assign views to the sensors named in the pairs; others that had them have none."""
        first: dict[str, str] = {}
        for view, serial in pairs:
            if serial not in first and view not in first.values():
                first[serial] = view
        taken = set(first.values())
        kept = {serial: view for serial, view in self._views.items() if view not in taken}
        self._views = kept | first

    @property
    def pairs(self) -> list[tuple[str, str]]:
        """Pairs of view and serial number."""
        return [(view, serial) for serial, view in self._views.items()]

    def view(self, serial: str) -> str:
        """Return the view of a sensor."""
        return self._views[serial]

    def welcome(self, serial: str, present: Collection[str], side: Sides) -> None:
        """Assign an unused view to a new sensor.

        Parameters
        ----------
        serial
            Serial number of the new sensor.
        present
            Serial numbers of the connected sensors.
        side
            What is captured.
        """
        if serial not in self._views:
            taken = {view for other, view in self._views.items() if other in present}
            names = (*(VIEWS_OF_BOTH if side == BOTH else USUAL_VIEWS), *_FURTHER_VIEWS)
            self.take([(next(name for name in names if name not in taken), serial)])

    def name(self, serial: str, view: str) -> None:
        """Assign a view to a sensor; the sensor that had it gets this one's view."""
        for other, taken in self._views.items():
            if taken == view and other != serial:
                self._views[other] = self._views[serial]
        self._views[serial] = view

    def swap(self, one: str, other: str) -> None:
        """Swap the views of two sensors."""
        self._views[one], self._views[other] = self._views[other], self._views[one]

    def request(
        self, ready: Iterable[str], options: CaptureOptions, without_motor: Collection[str] = ()
    ) -> PlanRequest:
        """Return the request for a capture by the ready sensors.

        If sensors are moved by hand, the first one captures the views without a sensor.

        Parameters
        ----------
        ready
            Serial numbers of the ready sensors.
        options
            Options of the capture.
        without_motor
            Serial numbers of sensors that cannot tilt; bursts are those of the others.
        """
        own = sorted((self._views[serial], serial) for serial in ready)
        if options.mode == "moved" and own:
            serials = dict(own)
            own = [(view, serials.get(view, own[0][1])) for view in options.views]
        fixed = tuple(sorted({serial for _, serial in own}.intersection(without_motor)))
        can_tilt = any(serial not in fixed for _, serial in own)
        bursts = options.bursts if can_tilt else 1
        return PlanRequest(
            tuple(own),
            frames=options.frames,
            simultaneous=options.mode == "together",
            bursts=bursts,
            without_motor=fixed if bursts > 1 else (),
        )


def options_of(request: PlanRequest, options: CaptureOptions) -> CaptureOptions:
    """Return the options with those that a request determines replaced.

    Parameters
    ----------
    request
        Request of an earlier capture.
    options
        The options to complete it with.
    """
    serials = [serial for _, serial in request.assignment]
    moved = len(set(serials)) < len(serials)
    return replace(
        options,
        mode="together" if request.simultaneous else "moved" if moved else "turns",
        views=tuple(view for view, _ in request.assignment) if moved else options.views,
        frames=request.frames,
        bursts=request.bursts,
    )
