"""File kinds for file dialogs."""

from __future__ import annotations

from insole_core.workflows.file_kind import CASE_SUFFIX, MESH_SUFFIXES
from insole_studio.texts import tr

TEMPLATE_SUFFIX = ".insole-template"


def case_kinds() -> str:
    """Return the filter for case files."""
    return tr("Insole Studio case") + f" (*{CASE_SUFFIX})"


def template_kinds() -> str:
    """Return the filter for template files."""
    return tr("Template of a prescription") + f" (*{TEMPLATE_SUFFIX})"


def scan_kinds() -> str:
    """Return the filter for archives and meshes."""
    patterns = " ".join(f"*{suffix}" for suffix in (".zip", *MESH_SUFFIXES))
    return tr("Session or mesh") + f" ({patterns})"
