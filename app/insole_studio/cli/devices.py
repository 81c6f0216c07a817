"""``insole-studio devices``, and the options by which designs start with a device and findings."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from insole_core.progress import Progress
from insole_core.visible_text import visible_line

if TYPE_CHECKING:
    from insole_core.foot.foot import Foot
    from insole_core.insole.prescription.design import InsoleDesign
    from insole_core.insole.prescription.materials import MaterialTable
    from insole_core.workflows.findings import Catalogue, Finding

NAME = "devices"
HELP = "list the devices and findings of the clinic: a line each with its key and its name"


def add_prescription_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options that name a device and findings."""
    parser.add_argument(
        "--device", metavar="NAME",
        help="make this device (see: insole-studio devices); as-scanned leaves the surface as it is"
        " (default: that of the clinic, or of the prescription)",
    )  # fmt: skip
    parser.add_argument(
        "--finding", action="append", default=[], metavar="NAME",
        help="apply what is proposed for a finding; may be given several times",
    )  # fmt: skip
    parser.add_argument(
        "--materials", metavar="FILE", type=Path,
        help="table of materials, with their least and usual thickness (default: the clinic's)",
    )  # fmt: skip


def prescribed(
    foot: Foot, prescription: InsoleDesign | None, arguments: argparse.Namespace
) -> InsoleDesign:
    """Return the design of a foot: its prescription, or a new one, with device and findings.

    Parameters
    ----------
    arguments
        With those that `add_arguments` adds.

    Raises
    ------
    InputError
        When there is no device or finding of this name, or no such table of materials.
    """
    from insole_core.foot.landmarks import find_landmarks
    from insole_core.insole.prescription.design import InsoleDesign
    from insole_core.insole.prescription.device import apply_device
    from insole_core.insole.prescription.materials import with_least_thickness
    from insole_core.workflows.clinic_devices import find_device
    from insole_core.workflows.findings import apply_finding, find_finding

    asked = (arguments.device, arguments.materials)
    if prescription is not None and asked == (None, None) and not arguments.finding:
        return prescription
    catalogue = clinic_catalogue()
    design = prescription or InsoleDesign(foot.side)
    if prescription is None or arguments.device is not None:
        name = arguments.device or catalogue.default_device
        design = apply_device(find_device(catalogue.devices, name), design)
    findings = clinic_findings() if arguments.finding else ()
    for name in arguments.finding:
        finding = find_finding(findings, name)
        design = apply_finding(finding, design, find_landmarks(foot), catalogue)
    return with_least_thickness(design, materials(arguments.materials))


def materials(path: Path | None) -> MaterialTable:
    """Return the table of materials of a file, or the clinic's, or that of the product.

    A table of the clinic that cannot be read is told on stderr.

    Raises
    ------
    InputError
        When the file cannot be read.
    """
    from insole_core.insole.prescription.materials import read_materials
    from insole_core.workflows.clinic_tables import ClinicMaterials
    from insole_studio.user_paths import UserPaths

    if path is not None:
        return read_materials(path)
    table, problem = ClinicMaterials(UserPaths.of_user().settings_folder).load()
    if problem is not None:
        print(f"Warning: {problem}", file=sys.stderr)
    return table


def clinic_catalogue() -> Catalogue:
    """Return the devices of the clinic and what else findings refer to.

    What the clinic keeps and cannot be read is told on stderr.
    """
    from insole_core.insole.clinic_rules import load_rules
    from insole_core.workflows.clinic_devices import DefaultDevice, clinic_devices, default_device
    from insole_core.workflows.findings import Catalogue
    from insole_core.workflows.pad_library import load_pads
    from insole_studio.user_paths import UserPaths

    folder = UserPaths.of_user().settings_folder
    listed = clinic_devices(folder).load()
    default, problem = default_device(listed.items, DefaultDevice(folder).load())
    for sentence in (*listed.unreadable, *((problem,) if problem else ())):
        print(f"Warning: {sentence}", file=sys.stderr)
    usual_mm = load_rules().pelott_usual_behind_heads_mm
    return Catalogue(listed.items, default.name, load_pads(), usual_mm)


def clinic_findings() -> tuple[Finding, ...]:
    """Return the findings of product and clinic; tell on stderr if the latter cannot be read."""
    from insole_core.workflows.clinic_findings import ClinicFindings
    from insole_studio.user_paths import UserPaths

    listed = ClinicFindings(UserPaths.of_user().settings_folder).load()
    for sentence in listed.unreadable:
        print(f"Warning: {sentence}", file=sys.stderr)
    return tuple(listed.items.values())


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument("--json", action="store_true", help="as JSON, for other programs")


def run(arguments: argparse.Namespace, _progress: Progress) -> None:
    """Print one line for each device and each finding."""
    from insole_core.insole.prescription.item_name import key_of

    catalogue = clinic_catalogue()
    default = key_of(catalogue.default_device)
    listed: list[dict[str, object]] = [
        {
            "kind": "device",
            "key": key,
            "name": device.name,
            "default": key == default,
            "keywords": list(device.keywords),
            "source": device.source,
        }
        for key, device in catalogue.devices.items()
    ]
    listed += [
        {
            "kind": "finding",
            "key": key_of(finding.name),
            "name": finding.name,
            "keywords": list(finding.keywords),
            "source": finding.source,
        }
        for finding in clinic_findings()
    ]
    if arguments.json:
        json.dump(listed, sys.stdout, indent=1, ensure_ascii=False)
        print()
        return
    for item in listed:
        mark = ["default"] if item.get("default") else []
        print(item["kind"], item["key"], visible_line(str(item["name"])), *mark, sep="\t")
