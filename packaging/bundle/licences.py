"""The texts for Help ▸ Licences, and the bill of materials (CycloneDX 1.6)."""

from __future__ import annotations

import json
import uuid
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from bundle import product
from bundle.components import Component

LICENCES = "licences.json"
BILL_OF_MATERIALS = "sbom.cdx.json"

REPLACING_QT = """\
Insole Studio uses Qt and Qt for Python (PySide6, Shiboken) under the GNU Lesser General Public \
License, version 3. You may replace them by other versions, also changed ones, of the same \
interface (Qt 6, PySide6 of the version that is listed here):

1. Close Insole Studio. Find its folder: /usr/lib/insole-studio (package), the folder you unpacked \
(archive), %LOCALAPPDATA%\\Programs\\Insole Studio (Windows), or Contents/Frameworks in the \
application (macOS).
2. Qt's libraries lie in _internal/PySide6/Qt/lib, its plugins in _internal/PySide6/Qt/plugins, \
the modules of Qt for Python in _internal/PySide6 and _internal/shiboken6 (on Windows all lie in \
_internal/PySide6).
3. Replace the files by yours of the same names. On macOS sign the application again: \
codesign --force --deep --sign - "Insole Studio.app".

The sources of Qt are at https://download.qt.io/official_releases/qt and those of Qt for Python at \
https://download.qt.io/official_releases/QtForPython, in the folder of the version listed here. \
Taking the program apart to see that such changes work is allowed.
"""


def licences_json(components: Iterable[Component], version: str) -> dict[str, Any]:
    """Return what Help ▸ Licences shows."""
    return {
        "program": {
            "name": product.NAME,
            "version": version,
            "licence": "BSD-3-Clause",
            "text": (product.ROOT / "LICENSE").read_text(encoding="utf-8"),
        },
        "replacing_qt": REPLACING_QT,
        "components": [
            {
                "name": component.name,
                "version": component.version,
                "licence": component.licence,
                "homepage": component.homepage,
                "texts": [{"name": name, "text": text} for name, text in component.texts],
                "contains": [{"name": name, "version": of} for name, of in component.libraries],
            }
            for component in components
        ],
    }


def bill_of_materials(components: Iterable[Component], version: str) -> dict[str, Any]:
    """Return the bill of materials; the same components give the same bill."""
    listed = [_bill_entry(component) for component in components]
    identity = uuid.uuid5(uuid.NAMESPACE_URL, json.dumps([version, listed], sort_keys=True))
    return {
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "serialNumber": f"urn:uuid:{identity}",
        "version": 1,
        "metadata": {
            "component": {
                "type": "application",
                "bom-ref": product.COMMAND,
                "name": product.COMMAND,
                "version": version,
                "licenses": [{"license": {"id": "BSD-3-Clause"}}],
            }
        },
        "components": listed,
        "dependencies": [
            {"ref": product.COMMAND, "dependsOn": [entry["bom-ref"] for entry in listed]}
        ],
    }


def _bill_entry(component: Component) -> dict[str, Any]:
    origin = {"deb": "deb/debian"}.get(component.origin, component.origin)
    address = f"pkg:{origin}/{component.name}@{component.version}"
    entry: dict[str, Any] = {
        "type": "library",
        "bom-ref": address,
        "name": component.name,
        "version": component.version,
        "purl": address,
        "licenses": [{"license": {"name": component.licence}}],
    }
    if component.homepage:
        entry["externalReferences"] = [{"type": "website", "url": component.homepage}]
    if component.libraries:
        entry["components"] = [
            {"type": "library", "bom-ref": f"{address}#{name}", "name": name}
            | ({"version": version} if version else {})
            for name, version in component.libraries
        ]
    return entry


def write_both(components: list[Component], version: str, folder: Path) -> list[Path]:
    """Write the texts and the bill of materials into a folder; return the files."""
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for name, content in (
        (LICENCES, licences_json(components, version)),
        (BILL_OF_MATERIALS, bill_of_materials(components, version)),
    ):
        path = folder / name
        path.write_text(json.dumps(content, indent=1, ensure_ascii=False), encoding="utf-8")
        written.append(path)
    return written
