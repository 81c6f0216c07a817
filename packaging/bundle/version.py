"""The version of a bundle: that of the tag it is built from."""

from __future__ import annotations

import re
import subprocess
import tomllib
from pathlib import Path

_DESCRIBED = re.compile(r"v?(?P<tag>\d[0-9A-Za-z.]*)-(?P<commits>\d+)-g(?P<commit>[0-9a-f]+)")


def version_of(checkout: Path) -> str:
    """Return the version of a checkout, such as ``1.2.0`` or, 5 commits on, ``1.2.0+5.gabc``.

    Without a tag it is the version of ``pyproject.toml``, with the commit if there is one. All of
    them are valid for Python and for Debian, and sorted by both as they came.
    """
    described = _git(checkout, "describe", "--tags", "--long", "--match", "v[0-9]*")
    if described:
        return from_description(described)
    declared = _declared(checkout)
    commit = _git(checkout, "rev-parse", "--short=8", "HEAD")
    return f"{declared}+g{commit}" if commit else declared


def from_description(described: str) -> str:
    """Return the version that `git describe --long` says.

    Raises
    ------
    ValueError
        When the tag is no version.
    """
    match = _DESCRIBED.fullmatch(described)
    if match is None:
        raise ValueError(f"the tag in {described!r} is no version; tags are like v1.2.0")
    if match["commits"] == "0":
        return match["tag"]
    return f"{match['tag']}+{match['commits']}.g{match['commit']}"


def _declared(checkout: Path) -> str:
    project = tomllib.loads((checkout / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return str(project["version"])


def _git(checkout: Path, *arguments: str) -> str:
    call = ["git", "-C", str(checkout), *arguments]
    try:
        answer = subprocess.run(call, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return ""
    return answer.stdout.strip() if answer.returncode == 0 else ""
