"""The request behind a plan, kept in the manifest so that a capture can be resumed later."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from insole_core.errors import UsageError
from insole_studio.acquisition.capture_plan import CapturePlan, make_plan

_KEY = "capture_plan"
"""Key in the manifest."""


@dataclass(frozen=True)
class PlanRequest:
    """The arguments that a plan is made from.

    Parameters
    ----------
    assignment, frames, color_frames, simultaneous, bursts
        As in `make_plan`.
    """

    assignment: tuple[tuple[str, str], ...]
    frames: int = 10
    color_frames: int = 1
    simultaneous: bool = False
    bursts: int = 1

    def plan(self) -> CapturePlan:
        """Make the plan.

        Raises
        ------
        UsageError
        """
        return make_plan(
            self.assignment,
            frames=self.frames,
            color_frames=self.color_frames,
            simultaneous=self.simultaneous,
            bursts=self.bursts,
        )

    def as_extra(self) -> dict[str, Any]:
        """Return the request in the form that the manifest keeps."""
        return {_KEY: asdict(self)}


def kept_request(extra: Mapping[str, Any]) -> PlanRequest | None:
    """Return the request that a manifest keeps; None if it keeps none that can be carried out.

    Parameters
    ----------
    extra
        The additional entries of the manifest.
    """
    try:
        kept = extra[_KEY]
        pairs = tuple((str(view), str(serial)) for view, serial in kept["assignment"])
        request = PlanRequest(**{**kept, "assignment": pairs})
        request.plan()
    except (KeyError, TypeError, ValueError, UsageError):
        return None
    return request
