"""The licences of all that the program comes with: the bundle's list, or the installed packages."""

from __future__ import annotations

import json
from dataclasses import dataclass
from importlib.metadata import Distribution, distributions

from insole_core.resources import resource_path

LIST = "licences/licences.json"
_NAMES = ("licen", "copying", "notice")


@dataclass(frozen=True)
class Licence:
    """A component and its licence.

    Parameters
    ----------
    licence
        Its short name; empty where the component does not give it.
    text
        In full; empty where the component brings none.
    """

    name: str
    version: str
    licence: str
    text: str


def licences() -> tuple[list[Licence], str]:
    """Return the licences, by name, and how Qt is replaced.

    Returns
    -------
    tuple of list and str
        The text is empty in an installation from the sources, where Qt is a package like others.
    """
    try:
        path = resource_path(LIST)
    except FileNotFoundError:
        found = {dist.name.lower(): _of_package(dist) for dist in distributions() if dist.name}
        return [found[name] for name in sorted(found)], ""
    listed = json.loads(path.read_text(encoding="utf-8"))
    parts = [
        Licence(
            part["name"],
            part["version"],
            part["licence"],
            "\n\n".join(f"{text['name']}\n\n{text['text']}" for text in part["texts"]),
        )
        for part in listed["components"]
    ]
    own = listed["program"]
    program = Licence(own["name"], own["version"], own["licence"], own["text"])
    return [program, *parts], listed["replacing_qt"]


def licence_text(found: list[Licence], replacing_qt: str) -> str:
    """Return a list of all, how Qt is replaced, and the texts in full."""
    lines = [f"{part.name} {part.version}: {part.licence or '?'}" for part in found]
    texts = [f"{part.name} {part.version}\n\n{part.text}" for part in found if part.text]
    return ("\n\n" + "=" * 72 + "\n\n").join(filter(None, ("\n".join(lines), replacing_qt, *texts)))


def _of_package(dist: Distribution) -> Licence:
    meta = dist.metadata.json
    texts = [
        file.read_text()
        for file in dist.files or ()
        if file.parts[0].endswith(".dist-info")
        and any(word in file.name.lower() for word in _NAMES)
    ]
    short = str(meta.get("license_expression") or meta.get("license") or "").split("\n")[0]
    return Licence(dist.name, dist.version, short, "\n\n".join(texts))
