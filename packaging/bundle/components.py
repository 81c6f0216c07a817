"""The works of others in a bundle: who made which file, under which licence."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import sysconfig
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass, field
from email import message_from_string
from email.message import Message
from functools import cache
from importlib.metadata import Distribution, distributions
from pathlib import Path, PurePath

LICENCE_FILE = re.compile(r"(?i)(licen[cs]e|copying|notice|copyright|authors)")
_COPY_OF_LIBRARY = re.compile(r"lib(?P<name>.+?)(-[0-9a-f]{8})+\.so\.?(?P<version>[0-9.a-z]*)")
_OWN = "insole-studio"
LICENCES = Path(__file__).resolve().parents[1] / "licences"
WITHOUT_TEXT = {
    "cvista": ("VTK.txt",),
    "cvista-rendering": ("VTK.txt",),
    "pyside6-essentials": ("LGPL-3.0.txt", "GPL-3.0.txt"),
    "shiboken6": ("LGPL-3.0.txt", "GPL-3.0.txt"),
}
"""Packages that come without the text of their licence: where it is."""


@dataclass(frozen=True)
class Component:
    """A work of others that a bundle contains, as a whole or in part."""

    name: str
    version: str
    origin: str
    """``pypi``, ``deb`` or ``generic``: where name and version come from."""
    licence: str
    """As its authors state it: an SPDX expression or their words."""
    homepage: str
    texts: tuple[tuple[str, str], ...]
    """Name and content of each licence file."""
    libraries: tuple[tuple[str, str], ...] = field(default=())
    """Name and version of libraries of yet others that came within it."""


def components_of(sources: Iterable[tuple[str, str]]) -> list[Component]:
    """Return the works to which bundled files belong, by name.

    Parameters
    ----------
    sources
        Place of each file in the bundle, and the file it is made from.

    Raises
    ------
    LookupError
        When a file belongs to no known work, or one has no text of its licence: nothing may be
        passed on without.
    """
    owners = _owners()
    files: dict[str, list[str]] = defaultdict(list)
    found: dict[str, Component] = {_python().name: _python()}
    for place, source in sources:
        owner = owners.get(source) or owners.get(str(Path(source).resolve()))
        if owner is not None:
            name = _normal_name(owner.metadata["Name"])
            files[name].append(place)
            if name not in found and name != _OWN:
                found[name] = _of_distribution(owner)
        elif not _is_own_or_of_python(Path(source)):
            component = _of_debian(Path(source))
            found.setdefault(component.name, component)
    silent = [component.name for component in found.values() if not component.texts]
    if silent:
        raise LookupError(f"no text of a licence is known for {', '.join(silent)}")
    return [
        _with_libraries(component, files.get(component.name, []))
        for component in sorted(found.values(), key=lambda component: component.name.lower())
    ]


@cache
def _owners() -> dict[str, Distribution]:
    return {
        os.path.normpath(str(distribution.locate_file(file))): distribution
        for distribution in distributions()
        for file in distribution.files or []
    }


def _is_own_or_of_python(source: Path) -> bool:
    roots = [Path(__file__).parents[2], Path(sysconfig.get_path("stdlib"))]
    if sys.base_prefix != "/usr":  # which holds everything else, too
        roots.append(Path(sys.base_prefix))
    return source.name.startswith(("base_library.zip", "libpython")) or any(
        source.resolve().is_relative_to(root.resolve()) for root in roots
    )


def _normal_name(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


def _of_distribution(distribution: Distribution) -> Component:
    metadata = metadata_of(distribution)
    texts = [
        (PurePath(file).name, _text(Path(str(distribution.locate_file(file)))))
        for file in distribution.files or []
        if LICENCE_FILE.match(PurePath(file).name) and PurePath(file).suffix not in {".py", ".pyc"}
    ]
    name = _normal_name(metadata["Name"])
    texts += [(text, _text(LICENCES / text)) for text in WITHOUT_TEXT.get(name, ())]
    return Component(
        name,
        distribution.version,
        "pypi",
        _licence(metadata),
        _homepage(metadata),
        tuple(texts),
    )


def metadata_of(distribution: Distribution) -> Message:
    """Return what a package says of itself."""
    return message_from_string(distribution.read_text("METADATA") or "")


def _licence(metadata: Message) -> str:
    if "License-Expression" in metadata:
        return str(metadata["License-Expression"])
    named = [
        line.split(" :: ")[-1]
        for line in metadata.get_all("Classifier", [])
        if line.startswith("License ::") and not line.endswith("OSI Approved")
    ]
    short = metadata.get("License", "").strip().splitlines()[:1]
    return " AND ".join(named) or (short[0] if short else "see its licence text")


def _homepage(metadata: Message) -> str:
    if "Home-page" in metadata:
        return str(metadata["Home-page"])
    lines = [line.lower() for line in metadata.get_all("Project-URL", []) if ", " in line]
    urls = dict(line.split(", ", 1) for line in lines)
    for label in ("homepage", "home", "source", "repository", "source code"):
        if label in urls:
            return urls[label]
    return next(iter(urls.values()), "")


def _of_debian(library: Path) -> Component:
    """Return the system package of a library, found by its file."""
    for path in (library, library.resolve()):
        for candidate in (str(path), f"/usr{path}"):  # /lib is /usr/lib, the package may say either
            owner = _output("dpkg-query", "-S", candidate)
            if owner:
                package = owner.split(":")[0]
                version, homepage = _output(
                    "dpkg-query", "-W", "-f", "${Version}\t${Homepage}\n", package
                ).splitlines()[0].split("\t")  # fmt: skip
                text = _text(Path("/usr/share/doc") / package / "copyright")
                return Component(
                    package, version, "deb", "see its licence text", homepage,
                    (("copyright", text),),
                )  # fmt: skip
    raise LookupError(f"{library} belongs to no Python package and no system package")


def _python() -> Component:
    version = ".".join(str(part) for part in sys.version_info[:3])
    places = [
        Path(sys.base_prefix) / "lib" / f"python{version.rsplit('.', 1)[0]}" / "LICENSE.txt",
        Path(sys.base_prefix) / "LICENSE.txt",
    ]
    texts = tuple((path.name, _text(path)) for path in places if path.is_file())
    return Component("python", version, "generic", "PSF-2.0", "https://www.python.org", texts)


def _with_libraries(component: Component, files: Iterable[str]) -> Component:
    """Add the libraries that a wheel brought, which carry a checksum in their names."""
    libraries = {
        (match["name"], match["version"])
        for file in files
        if (match := _COPY_OF_LIBRARY.fullmatch(PurePath(file).name))
    }
    return Component(
        component.name, component.version, component.origin, component.licence,
        component.homepage, component.texts, tuple(sorted(libraries)),
    )  # fmt: skip


def _output(*call: str) -> str:
    try:
        answer = subprocess.run(call, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return ""
    return answer.stdout if answer.returncode == 0 else ""


def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""
