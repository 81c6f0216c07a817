"""Keep a design as a finding, edit findings, and share them as files."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from insole_core.errors import InputError
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_differences import design_differences
from insole_core.insole.prescription.device import apply_device
from insole_core.insole.prescription.item_name import checked_name, key_of
from insole_core.workflows.clinic_devices import find_device
from insole_core.workflows.clinic_findings import ClinicFindings, export_findings, read_findings
from insole_core.workflows.findings import Catalogue, Finding, apply_finding
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_core.workflows.kept_finding import KeptFinding, finding_of
from insole_studio.features.design.correction_names import name_of
from insole_studio.services.app_services import AppServices
from insole_studio.services.files import FINDING_SUFFIX, Kept, finding_kinds
from insole_studio.texts import tr, translate_core_message
from insole_studio.widgets.form_parts import Field


class FindingActions:
    """What the menu of the list offers for findings.

    Parameters
    ----------
    storage
        The clinic's findings.
    catalogue
        Returns what findings refer to.
    renew
        Shows the list again, given the key of the finding to choose and what to say.
    """

    def __init__(
        self,
        services: AppServices,
        storage: ClinicFindings,
        catalogue: Callable[[], Catalogue],
        renew: Callable[[str, str], None],
    ) -> None:
        self._services = services
        self._storage = storage
        self._catalogue = catalogue
        self._renew = renew

    def keep(self) -> None:
        """Keep what this design has beyond its device as the proposal for a finding."""
        record = self._services.case.record
        design = record.design
        if design is None:
            return
        catalogue, landmarks = self._catalogue(), landmarks_of(record)
        unnamed = finding_of(design, "unnamed", landmarks, catalogue)
        start = _start(design, catalogue)
        proposed = apply_finding(unnamed.finding, start, landmarks, catalogue)
        lines = [translate_core_message(line) for line in design_differences(start, proposed)]
        if not lines:
            raise InputError(
                "This design has nothing beyond its device that a finding could propose; add a "
                "correction or a pad, or save it as a device."
            )
        sentence = "\n".join([tr("The finding proposes:"), *lines, *_notes(unnamed)])
        given = self._ask(tr("Keep as a finding"), sentence, Finding(""))
        if given is not None:
            self._store([_described(unnamed.finding, given)])

    def edit(self, finding: Finding) -> None:
        """Change name, keywords, advice and source; of a supplied one, the clinic gets its own."""
        sentence = tr(
            "What the finding proposes stays. To change that, keep a design under its name."
        )
        given = self._ask(tr("Edit the finding"), sentence, finding)
        if given is None:
            return
        changed = _described(finding, given)
        is_same = key_of(changed.name) == key_of(finding.name)
        self._store([changed], instead_of=finding.name, may_replace=is_same)

    def import_file(self) -> None:
        """Take the findings of a file of another clinic."""
        path = self._services.messages.questions.file_to_open(finding_kinds(), Kept.CASES)
        if path is not None:
            self._store(read_findings(path))

    def export(self, finding: Finding) -> None:
        """Write a finding to a file for another clinic."""
        self._export([finding], key_of(finding.name))

    def export_own(self) -> None:
        """Write all findings of the clinic to a file for another one."""
        listed = self._storage.load()
        self._export([listed.items[key] for key in sorted(listed.own)], tr("own findings"))

    def remove(self, finding: Finding) -> None:
        """Remove a finding of the clinic."""
        self._storage.remove(finding.name)
        self._renew("", tr("Removed: {name}").format(name=translate_core_message(finding.name)))

    def reset(self) -> None:
        """Return to the supplied findings; those of the clinic are kept in a file."""
        kept = self._storage.reset()
        if kept is not None:
            said = tr("The supplied findings apply again; the clinic's are kept as {name}")
            self._renew("", said.format(name=kept.name))

    def _export(self, findings: Sequence[Finding], stem: str) -> None:
        name = f"{stem}{FINDING_SUFFIX}"
        path = self._services.messages.questions.file_to_write(name, finding_kinds(), Kept.CASES)
        if path is not None:
            export_findings(findings, path)
            self._services.messages.say(tr("Written: {name}").format(name=path.name))

    def _store(
        self, findings: Sequence[Finding], instead_of: str = "", *, may_replace: bool = False
    ) -> None:
        """Store findings, but those whose name the clinic wants to keep for another."""
        own, questions = self._storage.load().own, self._services.messages.questions
        taken = [
            finding
            for finding in findings
            if may_replace
            or key_of(finding.name) not in own
            or questions.may_replace_own(finding.name)
        ]
        if taken:
            self._storage.save(taken, instead_of)
            names = ", ".join(finding.name for finding in taken)
            self._renew(
                f"finding:{key_of(taken[-1].name)}", tr("Stored: {name}").format(name=names)
            )

    def _ask(self, title: str, sentence: str, finding: Finding) -> dict[str, str] | None:
        """Let the user describe a finding."""
        texts = _texts(finding)
        fields = [
            Field("name", tr("Name"), texts["name"]),
            Field("keywords", tr("Keywords, with commas"), texts["keywords"], required=False),
            Field("advice", tr("Advice"), texts["advice"], required=False),
            Field("source", tr("Source"), texts["source"], required=False),
        ]
        return self._services.messages.questions.fields(title, sentence, fields)


def _start(design: InsoleDesign, catalogue: Catalogue) -> InsoleDesign:
    """Return a design without corrections, of the same device or else the clinic's."""
    known = design.device if key_of(design.device) in catalogue.devices else ""
    device = find_device(catalogue.devices, known or catalogue.default_device)
    return apply_device(device, InsoleDesign(design.side))


def _notes(kept: KeptFinding) -> list[str]:
    notes = []
    if kept.left_out:
        names = ", ".join(map(name_of, kept.left_out))
        notes.append(tr("Of this foot alone, and not part of it: {names}").format(names=names))
    if kept.moved:
        names = ", ".join(map(name_of, kept.moved))
        notes.append(
            tr("At the usual place instead of the present one: {names}").format(names=names)
        )
    return notes


def _texts(finding: Finding) -> dict[str, str]:
    """Return what describes a finding, in the language of the window."""
    return {
        "name": translate_core_message(finding.name),
        "keywords": ", ".join(map(translate_core_message, finding.keywords)),
        "advice": translate_core_message(finding.advice),
        "source": translate_core_message(finding.source),
    }


def _described(finding: Finding, given: dict[str, str]) -> Finding:
    """Return a finding with what was entered; a text that was left as shown stays as it is."""
    before = _texts(finding)
    changes = {key: text for key, text in given.items() if text != before[key]}
    keywords = changes.pop("keywords", None)
    changed = replace(finding, **changes)  # type: ignore[arg-type]
    if keywords is not None:
        words = tuple(word.strip() for word in keywords.split(",") if word.strip())
        changed = replace(changed, keywords=words)
    return replace(changed, name=checked_name(changed.name))
