"""What a plan was made from, kept in the manifest, so that a capture can be gone on with later."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from insole_core.errors import UsageError
from insole_studio.acquisition.capture_plan import CapturePlan, make_plan

_KEY = "capture_plan"
"""Of the manifest."""


@dataclass(frozen=True)
class PlanRequest:
    """What was asked for.

    Parameters
    ----------
    assignment, frames, color_frames, simultaneous, bursts
        As `make_plan` takes them.
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
        """Give it as the manifest keeps it."""
        return {_KEY: asdict(self)}


def kept_request(extra: Mapping[str, Any]) -> PlanRequest | None:
    """Give the request that a manifest keeps; None where it keeps none that can be carried out."""
    try:
        kept = extra[_KEY]
        pairs = tuple((str(view), str(serial)) for view, serial in kept["assignment"])
        request = PlanRequest(**{**kept, "assignment": pairs})
        request.plan()
    except (KeyError, TypeError, ValueError, UsageError):
        return None
    return request
