"""Measures of a finished insole's form, with what is asked of each (decision 0036)."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np
from scipy.ndimage import binary_dilation

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.insole.build import Insole, build_insole
from insole_core.insole.elements import HeelCup
from insole_core.insole.finishing.finished import FinishedSurface
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.surface.contact import ContactBase, contact_base
from insole_core.insole.surface.pads_on_surface import apply_pads

RIM_STEP_MM = 5.0
TOE_CORNER_MM, BUMP_STEP_MM, BUMP_DEPTH_MM = 20.0, 10.0, 12.0


@dataclass(frozen=True)
class Form:
    """What is measured of one insole; mm, degrees, 1/mm.

    Parameters
    ----------
    rim_rms_mm, rim_max_mm
        Of the surface's edge against the designed curve.
    rim_bend_mm
        Greatest second difference of the edge in steps of 5 mm.
    toe_range_mm
        Of the heights in a flat toe zone, without its corners; 0 where the zone is not flat.
    toe_bump_mm
        Greatest height ahead of the toe line, within 12 mm of the edge, over the mean of the
        heights 10 mm before and behind it along the edge; 0 where the zone is not flat.
    support_change_mm
        Greatest change of the contact surface in the supporting zone, without smoothing of skin,
        fill and expansion.
    support_share
        Of the measured sole behind the heads.
    band_laplacian, seam_laplacian
        Root mean square in the band along the rim; greatest at the border of the supporting zone.
    slope_deg
        Of the steepest place; behind the heads only, where the toes stay as scanned.
    pad_change_mm
        Greatest change of a pad's height by the finish.
    """

    rim_rms_mm: float
    rim_max_mm: float
    rim_bend_mm: float
    toe_range_mm: float
    toe_bump_mm: float
    support_change_mm: float
    support_share: float
    band_laplacian: float
    seam_laplacian: float
    slope_deg: float
    pad_change_mm: float


ASKED = {
    "rim_rms_mm": 0.1, "rim_max_mm": 0.2, "rim_bend_mm": 0.4, "toe_range_mm": 0.3,
    "toe_bump_mm": 0.75, "support_change_mm": 0.01, "support_share": 0.65, "band_laplacian": 0.1,
    "seam_laplacian": 0.3, "slope_deg": 60.0, "pad_change_mm": 1e-6,
}  # fmt: skip
"""Greatest value, of the share the least."""


def missed(form: Form) -> list[str]:
    """Return the names of the measures that are not what is asked."""
    values = {f.name: getattr(form, f.name) for f in fields(form)}
    share = values.pop("support_share")
    over = [name for name, value in values.items() if value > ASKED[name]]
    return over + ["support_share"] * (share < ASKED["support_share"])


def measured_form(foot: Foot, design: InsoleDesign) -> Form:
    """Build the insole of a design with a finish, and measure it."""
    insole = build_insole(foot, design)
    base = contact_base(foot, design)
    finished = base.finished
    assert finished is not None
    deviation = _edge_mm(finished) - finished.curve.height_mm
    return Form(
        rim_rms_mm=float(np.sqrt((deviation**2).mean())),
        rim_max_mm=float(np.abs(deviation).max()),
        rim_bend_mm=_bend_mm(finished),
        toe_range_mm=_toe_range_mm(finished),
        toe_bump_mm=_toe_bump_mm(finished),
        support_change_mm=_support_change_mm(foot, design),
        support_share=float(finished.zones.support[_sole(base, finished)].mean()),
        band_laplacian=_band_laplacian(finished),
        seam_laplacian=_seam_laplacian(finished),
        slope_deg=_slope_deg(finished),
        pad_change_mm=_pad_change_mm(insole, base),
    )


def _edge_mm(finished: FinishedSurface) -> FloatArray:
    """Return the heights of the surface at the points of the edge, over the heel's floor."""
    heights = finished.surface.height_at(finished.rim.edge.points_mm)
    return np.asarray(heights - finished.heel_mm)


def _bend_mm(finished: FinishedSurface) -> float:
    edge, heights = finished.rim.edge, _edge_mm(finished)
    apart = [edge.at(heights, edge.arc_mm + way) for way in (-RIM_STEP_MM, RIM_STEP_MM)]
    return float(np.abs(apart[0] + apart[1] - 2 * heights).max())


def _toe_range_mm(finished: FinishedSurface) -> float:
    """Measure where rim and transition end, without the corners between them."""
    if finished.finish.toe_zone != "flat":
        return 0.0
    from_rim = finished.place.inside_mm - finished.place.at_edge(finished.widths.width_mm)
    from_line = finished.toes.ahead_mm - finished.toes.end_mm
    in_corner = (from_rim < TOE_CORNER_MM) & (from_line < TOE_CORNER_MM)
    heights = finished.surface.heights_mm[finished.toes.floor & (from_rim > 0) & ~in_corner]
    return float(np.ptp(heights)) if heights.size else 0.0


def _toe_bump_mm(finished: FinishedSurface) -> float:
    if finished.finish.toe_zone != "flat":
        return 0.0
    lines, surface = finished.place.lines_inward, finished.surface
    places = lines.places_mm[:, lines.depth_mm <= BUMP_DEPTH_MM]
    heights = surface.height_at(places)
    ahead = replace(surface, heights_mm=finished.toes.ahead_mm).height_at(places)
    lag = round(BUMP_STEP_MM / finished.rim.edge.step_mm)
    over = heights - (np.roll(heights, lag, axis=0) + np.roll(heights, -lag, axis=0)) / 2
    return float(over[ahead > finished.toes.begin_mm].max(initial=0.0))


def _support_change_mm(foot: Foot, design: InsoleDesign) -> float:
    assert design.finish is not None
    plain = replace(design.finish, skin_smoothing_mm=0.0, arch_fill_mm=0.0, expansion_mm=0.0)
    finished = contact_base(foot, replace(design, finish=plain)).finished
    assert finished is not None
    corrections = tuple(c for c in design.corrections if not isinstance(c, HeelCup))
    as_scanned = contact_base(foot, replace(design, finish=None, corrections=corrections))
    change = finished.surface.heights_mm - as_scanned.surface.heights_mm
    change = change[finished.zones.support]
    return float(np.ptp(change)) if change.size else 0.0  # both are raised to their thickness


def _sole(base: ContactBase, finished: FinishedSurface) -> BoolArray:
    """Return the measured nodes of the insole behind the heads."""
    inside = base.measured & (finished.place.inside_mm > 0)
    return np.asarray(inside & (finished.toes.ahead_mm < 0))


def _free(finished: FinishedSurface) -> BoolArray:
    """Return the inner nodes that belong to no zone."""
    inside = finished.place.inside_mm > finished.surface.step_mm
    return np.asarray(inside & ~finished.zones.support & ~finished.zones.floor)


def _band_laplacian(finished: FinishedSurface) -> float:
    from_rim = finished.place.inside_mm - finished.place.at_edge(finished.widths.width_mm)
    band = finished.surface.laplacian()[_free(finished) & (from_rim <= 0)]
    return float(np.sqrt((band**2).mean()))


def _seam_laplacian(finished: FinishedSurface) -> float:
    free, support = _free(finished), finished.zones.support
    seam = (support & binary_dilation(free)) | (free & binary_dilation(support))
    return float(np.abs(finished.surface.laplacian()[seam & _designed(finished)]).max(initial=0.0))


def _designed(finished: FinishedSurface) -> BoolArray:
    """Return the nodes that are not toes as they were scanned."""
    as_scanned = finished.finish.toe_zone == "as_scanned"
    return np.asarray((finished.toes.ahead_mm < 0) | (not as_scanned))


def _slope_deg(finished: FinishedSurface) -> float:
    inside = finished.place.inside_mm > finished.surface.step_mm
    return float(finished.surface.slope_deg()[inside & _designed(finished)].max())


def _pad_change_mm(insole: Insole, base: ContactBase) -> float:
    """Compare what pads add with what they add to a plane."""
    level = replace(base.surface, heights_mm=np.zeros_like(base.surface.heights_mm))
    alone = apply_pads(replace(base, surface=level), insole.design).heights_mm
    added = insole.contact.heights_mm - base.surface.heights_mm
    return float(np.abs(added - alone).max())
