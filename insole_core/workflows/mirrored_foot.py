"""The foot that was not scanned, as the mirror image of the other one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Final

import numpy as np

from insole_core.cases.case_record import Annotations, FootRecord, KeyPoint, Point
from insole_core.foot.foot import Foot
from insole_core.insole.elements import Correction
from insole_core.workflows.template_transfer import fitted, template_of

_MIRROR: Final = np.diag([-1.0, 1.0, 1.0, 1.0])
"""In the plane x = 0, which holds the foot axis."""


def mirrored_foot(record: FootRecord, stamp: Callable[[Correction], Correction]) -> FootRecord:
    """Return foot, landmarks and prescription of the other side as the mirror image of this one.

    It is marked as such, so that window, papers and files say it. What lies under the scanned foot
    alone, such as a map of its pressures, is left out.

    Parameters
    ----------
    stamp
        Returns a correction with author and time of the new prescription.

    Raises
    ------
    DesignError
        When the landmarks are in an impossible order.
    """
    foot, source = record.foot, record.source
    mirror_image = Foot(
        foot.side.other,
        foot.mesh.mirrored(),
        _MIRROR @ foot.source2insole @ _MIRROR,  # that of the mirrored scan
        foot.length_mm,
        form=foot.form,
        mirrored=not foot.mirrored,
        scanned_on=foot.scanned_on,
    )
    made = FootRecord.begun(
        mirror_image,
        replace(source, mirrored=not source.mirrored),
        annotations=_mirrored(record.annotations),
    )
    return made.with_design(fitted(template_of(record), made, stamp))


def _mirrored(annotations: Annotations) -> Annotations:
    points = (KeyPoint(p.name, _reflected(p.position_mm)) for p in annotations.key_points)
    plane = annotations.plane
    if plane is not None:
        plane = replace(plane, origin_mm=_reflected(plane.origin_mm), roll_deg=-plane.roll_deg)
    return Annotations(tuple(points), plane)


def _reflected(place_mm: Point) -> Point:
    x, y, z = place_mm
    return -x, y, z
