"""Which sensor gives which view, and what is to be captured by that."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import replace

from insole_studio.acquisition.plan_request import PlanRequest
from insole_studio.features.capture.rows import USUAL_VIEWS, CaptureOptions

_FURTHER_VIEWS = tuple(f"view_{number}" for number in range(4, 12))


class ViewAssignment:
    """View by serial number; sensors that are not plugged in keep theirs.

    Parameters
    ----------
    pairs
        View and serial number; of a sensor that is named twice the first counts.
    """

    def __init__(self, pairs: Iterable[tuple[str, str]]) -> None:
        self._views: dict[str, str] = {}
        self.take(pairs)

    def take(self, pairs: Iterable[tuple[str, str]]) -> None:
        """Assign anew, for the sensors that are named."""
        first: dict[str, str] = {}
        for view, serial in pairs:
            first.setdefault(serial, view)
        self._views |= first

    @property
    def pairs(self) -> list[tuple[str, str]]:
        """View and serial number."""
        return [(view, serial) for serial, view in self._views.items()]

    def view(self, serial: str) -> str:
        """Give the view of a sensor."""
        return self._views[serial]

    def welcome(self, serial: str, present: Collection[str]) -> None:
        """Give a sensor that is new a view that no other has."""
        if serial not in self._views:
            taken = {view for other, view in self._views.items() if other in present}
            names = (*USUAL_VIEWS, *_FURTHER_VIEWS)
            self._views[serial] = next(name for name in names if name not in taken)

    def name(self, serial: str, view: str) -> None:
        """Give a sensor a view; the one that had it gets this one's."""
        for other, taken in self._views.items():
            if taken == view and other != serial:
                self._views[other] = self._views[serial]
        self._views[serial] = view

    def swap(self, one: str, other: str) -> None:
        """Exchange the views of two sensors."""
        self._views[one], self._views[other] = self._views[other], self._views[one]

    def request(self, ready: Iterable[str], options: CaptureOptions) -> PlanRequest:
        """Say what is to be captured by the sensors that are ready.

        Where sensors are moved by hand, a view that has none is taken by the first one.
        """
        own = sorted((self._views[serial], serial) for serial in ready)
        if options.mode == "moved" and own:
            serials = dict(own)
            own = [(view, serials.get(view, own[0][1])) for view in options.views]
        return PlanRequest(
            tuple(own),
            frames=options.frames,
            simultaneous=options.mode == "together",
            bursts=options.bursts,
        )


def options_of(request: PlanRequest, options: CaptureOptions) -> CaptureOptions:
    """Give the choices that lead to a request, as far as it tells."""
    serials = [serial for _, serial in request.assignment]
    moved = len(set(serials)) < len(serials)
    return replace(
        options,
        mode="together" if request.simultaneous else "moved" if moved else "turns",
        views=tuple(view for view, _ in request.assignment) if moved else options.views,
        frames=request.frames,
        bursts=request.bursts,
    )
