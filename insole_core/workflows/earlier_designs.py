"""Find earlier prescriptions of a patient among recent case files."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from pathlib import Path

from insole_core.cases.case_file import read_case
from insole_core.cases.case_record import Patient
from insole_core.errors import InsoleError
from insole_core.geometry.side import Side
from insole_core.insole.prescription.template import Template
from insole_core.progress import SILENT, Progress
from insole_core.workflows.file_kind import CASE_SUFFIX
from insole_core.workflows.template_transfer import last_design, prescribed_at

log = logging.getLogger(__name__)


def identity(patient: Patient) -> tuple[str, str] | None:
    """Return normalised name and birth date; None while either is missing."""
    name, born = " ".join(patient.name.casefold().split()), patient.born.strip()
    return (name, born) if name and born else None


def find_last_design(
    paths: Sequence[Path], patient: Patient, side: Side, progress: Progress = SILENT
) -> Template | None:
    """Find the latest prescription of a patient for a side.

    Parameters
    ----------
    paths
        Candidates; files that are not cases or cannot be read are skipped.

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
        template = None if foot is None else last_design(foot)
        if wanted is not None and identity(record.patient) == wanted and template is not None:
            templates.append(template)
    return max(templates, key=lambda template: prescribed_at(template.design), default=None)
