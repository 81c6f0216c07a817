"""The design that a foot begins with: the usual device, an earlier one, that of the other foot."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from datetime import date
from pathlib import Path

from insole_core.cases.case_file import read_case
from insole_core.cases.case_record import Annotations, FootRecord, Patient, Point
from insole_core.errors import DesignError, InsoleError
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import Correction, new_id
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import Device, apply_device
from insole_core.insole.prescription.materials import MaterialTable, with_least_thickness
from insole_core.insole.prescription.template import (
    Template,
    apply_template,
    make_template,
    mirrored,
)
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.workflows.clinic_devices import DefaultDevice, clinic_devices, default_device
from insole_core.workflows.clinic_tables import ClinicMaterials
from insole_core.workflows.file_kind import CASE_SUFFIX
from insole_core.workflows.foot_landmarks import landmarks_of

log = logging.getLogger(__name__)


@dataclass(frozen=True)
class StartingDevice:
    """The device of new designs.

    Parameters
    ----------
    materials
        The clinic's table.
    problem
        Why it is not the clinic's choice, a sentence; None if it is.
    """

    device: Device
    materials: MaterialTable
    problem: Message | None = None

    def design(self, foot: Foot) -> InsoleDesign:
        """Return a new design for a foot, without expansion where its tissue was spread already."""
        return self._begun(foot.side, is_spread=foot.form.is_spread)

    def prescribes(self, design: InsoleDesign) -> bool:
        """Return whether a design holds anything that a new one does not."""
        begun = (self._begun(design.side, is_spread=spread) for spread in (False, True))
        return design not in (InsoleDesign(design.side), *begun)

    def _begun(self, side: Side, *, is_spread: bool) -> InsoleDesign:
        design = apply_device(self.device, InsoleDesign(side))
        if is_spread and design.finish is not None:
            design = replace(design, finish=replace(design.finish, expansion_mm=0.0))
        return with_least_thickness(design, self.materials)


def starting_device(folder: Path) -> StartingDevice:
    """Return the device of new designs.

    Parameters
    ----------
    folder
        Of the clinic's settings.
    """
    devices = clinic_devices(folder).load().items
    device, problem = default_device(devices, DefaultDevice(folder).load())
    return StartingDevice(device, ClinicMaterials(folder).load()[0], problem)


def template_of(foot: FootRecord) -> Template:
    """Return the chosen prescription of a foot as a template for another foot.

    Raises
    ------
    DesignError
        When the landmarks are in an impossible order.
    """
    return make_template(foot.chosen, foot.design, landmarks_of(foot))


def fitted(
    template: Template, foot: FootRecord, stamp: Callable[[Correction], Correction]
) -> InsoleDesign:
    """Fit a prescription to a foot by its landmarks, mirrored where it is of the other side.

    It counts as a new prescription: every correction gets a new id and a new stamp.

    Parameters
    ----------
    stamp
        Returns a correction with author and time of the new prescription.

    Raises
    ------
    DesignError
        When the landmarks are in an impossible order.
    """
    return _as_new(apply_template(template, foot.side, landmarks_of(foot)), stamp)


def _as_new(design: InsoleDesign, stamp: Callable[[Correction], Correction]) -> InsoleDesign:
    fresh = (stamp(replace(c, id=new_id())) for c in design.corrections)
    return replace(design, corrections=tuple(fresh))


def last_design(foot: FootRecord, starting: StartingDevice) -> Template | None:
    """Return the last prescription for a foot, on this scan or the previous one.

    Parameters
    ----------
    starting
        The device that new prescriptions begin with: a design as it begins is none.
    """
    if not starting.prescribes(foot.design):
        return foot.earlier
    try:
        return template_of(foot)
    except DesignError:
        return foot.earlier


def prescribed_at(design: InsoleDesign) -> str:
    """Return the time (ISO 8601) of the latest correction; empty where none is recorded."""
    return max((correction.created_at for correction in design.corrections), default="")


def identity(patient: Patient) -> tuple[str, str] | None:
    """Return normalised name and birth date; None while either is missing."""
    name, born = " ".join(patient.name.casefold().split()), patient.born.strip()
    return (name, born) if name and born else None


def find_last_design(
    paths: Sequence[Path],
    patient: Patient,
    side: Side,
    starting: StartingDevice,
    progress: Progress = SILENT,
) -> Template | None:
    """Find the latest prescription of a patient for a side.

    Parameters
    ----------
    paths
        Candidates; files that are not cases or cannot be read are skipped.
    starting
        As of `last_design`.

    Returns
    -------
    Template
        None when there is none, or while the patient has no name or birth date.

    Raises
    ------
    Cancelled
    """
    wanted = identity(patient)
    templates: list[Template] = []
    cases = [path for path in paths if path.suffix.lower() == CASE_SUFFIX and path.exists()]
    for number, path in enumerate(cases):
        progress.step(number / len(cases), "Looking for earlier designs")
        try:
            record = read_case(path)
        except InsoleError as error:
            log.info("no earlier design: %s", error)
            continue
        foot = record.of_side(side)
        template = None if foot is None else last_design(foot, starting)
        if wanted is not None and identity(record.patient) == wanted and template is not None:
            templates.append(template)
    return max(templates, key=lambda template: prescribed_at(template.design), default=None)


def on_earlier_scan(record: FootRecord, scanned_on: date, starting: StartingDevice) -> FootRecord:
    """Return a foot for a new prescription on the scan of an earlier visit, with its landmarks.

    It is marked with the day of the visit that it was scanned on, so that window, papers and record
    say it. The earlier prescription is there to be repeated.

    Parameters
    ----------
    record
        The foot as the earlier visit has it.
    scanned_on
        Day of the visit that it was scanned on.
    starting
        The device that new prescriptions begin with.
    """
    day = scanned_on.isoformat()
    return FootRecord.begun(
        replace(record.foot, scanned_on=day),
        replace(record.source, scanned_on=day),
        starting.design(record.foot),
        annotations=record.annotations,
        earlier=last_design(record, starting),
    )


def mirrored_foot(record: FootRecord, stamp: Callable[[Correction], Correction]) -> FootRecord:
    """Return foot, landmarks and prescription of the other side as the mirror image of this one.

    It is marked as such, so that window, papers and files say it. What lies under the scanned foot
    alone, such as a map of its pressures, is left out.

    Parameters
    ----------
    stamp
        Returns a correction with author and time of the new prescription.
    """
    source = record.source
    design = mirrored(record.design)
    return FootRecord.begun(
        record.foot.mirror_image(),
        replace(source, mirrored=not source.mirrored),
        _as_new(design, stamp),
        annotations=_mirrored(record.annotations),
    )


def _mirrored(annotations: Annotations) -> Annotations:
    points = (replace(p, position_mm=_reflected(p.position_mm)) for p in annotations.key_points)
    plane = annotations.plane
    if plane is not None:
        plane = replace(plane, origin_mm=_reflected(plane.origin_mm), roll_deg=-plane.roll_deg)
    return Annotations(tuple(points), plane)


def _reflected(place_mm: Point) -> Point:
    x, y, z = place_mm
    return -x, y, z
