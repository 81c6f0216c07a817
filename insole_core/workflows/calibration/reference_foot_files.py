"""The files of the reference foot: what is printed, and the certificate that belongs to it."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from insole_core.calibration.markers.reference_file import save_reference_system
from insole_core.evaluation.known_form import Scan
from insole_core.evaluation.known_object import KnownPlaced
from insole_core.evaluation.printed_body import PrintedBar
from insole_core.files.atomic import replacing_folder, write_text
from insole_core.files.temporary import is_unfinished
from insole_core.formats.stl import write_stl
from insole_core.simulate.reference_foot import (
    BAR_MM,
    NAME,
    reference_foot,
    scale_bar,
)
from insole_core.workflows.calibration.reference_foot_paper import (
    BAR_FILE,
    BODY_FILE,
    certificate,
    write_paper,
)

SYSTEM_FILE, CERTIFICATE, PAPER = "reference-system.json", "certificate.json", "certificate.pdf"
FILES = {BODY_FILE, BAR_FILE, SYSTEM_FILE, CERTIFICATE, PAPER}


def known_reference_foot(callipers: Sequence[float] | None) -> KnownPlaced:
    """Return what is known of the reference foot.

    Parameters
    ----------
    callipers
        Readings of the printed bar, mm: its edges along x, y and z, and its two diagonals; None
        where nobody has measured it.

    Raises
    ------
    CalibrationError
        When the readings contradict each other, or the print is too far off.
    """
    foot = reference_foot()
    if callipers is None:
        return KnownPlaced(Scan(foot.form, foot.is_foot), NAME, foot.system)
    x, y, z, first, second = callipers
    bar = PrintedBar(BAR_MM, (x, y, z), (first, second))
    printed = foot.printed(bar)
    return KnownPlaced(Scan(printed.form, foot.is_foot), NAME, printed.system, bar)


def write_reference_foot(folder: Path) -> None:
    """Write the reference foot, its scale bar, its reference system and its certificate.

    Parameters
    ----------
    folder
        New, empty, or with earlier files of a reference foot only.

    Raises
    ------
    OutputError
        When the place cannot be written; what was there before is untouched.
    """
    foot = reference_foot()
    body, bar = foot.to_print(), scale_bar()
    with replacing_folder(folder, _foreign) as beside:
        write_stl(body, beside / BODY_FILE, NAME)
        write_stl(bar, beside / BAR_FILE, NAME)
        save_reference_system(foot.system, beside / SYSTEM_FILE)
        text = json.dumps(certificate(foot, body, bar), indent=1)
        write_text(text + "\n", beside / CERTIFICATE)
        write_paper(foot, body, bar, beside / PAPER)


def _foreign(folder: Path) -> str | None:
    names = {path.name for path in folder.iterdir() if not is_unfinished(path)}
    return min(names - FILES, default=None)
