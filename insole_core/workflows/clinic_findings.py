"""The findings of the product, and those of the clinic in their places and beside them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path

from insole_core.errors import InputError
from insole_core.files.atomic import make_output_folder, replacing_file
from insole_core.forgiving_json import keep_unreadable, set_aside
from insole_core.insole.prescription.item_name import key_of
from insole_core.resources import resource_path
from insole_core.workflows.finding_file import read_findings, write_findings
from insole_core.workflows.findings import Finding
from insole_core.workflows.named_files import Listed


class ClinicFindings:
    """Storage of findings; all of the clinic's are in one file.

    A finding of the clinic takes the place of one of the product with the same name, until it is
    removed.

    Parameters
    ----------
    folder
        Of the clinic's settings; while there is no file of findings in it, the product's apply.
    """

    def __init__(self, folder: Path) -> None:
        self._path = folder / "findings.json"

    def load(self) -> Listed[Finding]:
        """Return all findings.

        Raises
        ------
        InputError
            When those of the product cannot be read.
        """
        items = _by_key(read_findings(resource_path("findings/findings.json")))
        try:
            own = _by_key(self._own())
        except InputError as error:
            return Listed(items, frozenset(), (error.message,))
        return Listed(dict(sorted((items | own).items())), frozenset(own), ())

    def save(self, findings: Sequence[Finding], instead_of: str = "") -> None:
        """Store findings of the clinic; those of the same names are replaced.

        A file that cannot be read is kept under another name.

        Parameters
        ----------
        instead_of
            Name of one that goes: under which a finding was stored before.

        Raises
        ------
        OutputError
            When the place cannot be written.
        """
        make_output_folder(self._path.parent)
        if self._path.exists():
            keep_unreadable(self._path, self._own)
        own = _by_key(self._own())
        own.pop(key_of(instead_of), None)
        export_findings(tuple((own | _by_key(findings)).values()), self._path)

    def remove(self, name: str) -> None:
        """Remove a finding of the clinic; one of the product of that name comes back.

        Raises
        ------
        OutputError
            When the place cannot be written.
        """
        self.save((), instead_of=name)

    def reset(self) -> Path | None:
        """Return to the findings of the product.

        Returns
        -------
        Path or None
            Where the clinic's are kept, to be imported again; None if it has none.
        """
        return set_aside(self._path, "kept") if self._path.exists() else None

    def _own(self) -> tuple[Finding, ...]:
        return read_findings(self._path) if os.path.lexists(self._path) else ()


def export_findings(findings: Sequence[Finding], path: Path) -> None:
    """Write findings to a file for another clinic to import.

    Raises
    ------
    OutputError
        When the place cannot be written.
    """
    with replacing_file(path) as beside:
        write_findings(findings, beside)


def _by_key(findings: Iterable[Finding]) -> dict[str, Finding]:
    return {key_of(finding.name): finding for finding in findings}
