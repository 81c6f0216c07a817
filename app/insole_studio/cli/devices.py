"""``insole-studio devices``: list the devices and findings that designs can start with."""

from __future__ import annotations

import argparse
import json
import sys

from insole_core.progress import Progress
from insole_core.visible_text import visible_line
from insole_studio.cli.prescribed import clinic_catalogue, clinic_findings

NAME = "devices"
HELP = "list the devices and findings of the clinic: a line each with its key and its name"


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
