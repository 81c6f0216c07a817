"""The works of others in a bundle: who made which file, under which licence."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import sysconfig
from collections import defaultdict
from collections.abc import Container, Iterable, Sequence
from dataclasses import dataclass, field, replace
from email import message_from_string
from email.message import Message
from fnmatch import fnmatchcase
from functools import cache
from importlib.metadata import Distribution, distribution, distributions
from pathlib import Path, PurePath

LICENCE_FILE = re.compile(r"(?i)(.+\.)?(licen[cs]e|copying|notice|copyright|authors)")
_COPY_OF_LIBRARY = re.compile(r"lib(?P<name>.+?)(-[0-9a-f]{8})+\.so\.?(?P<version>[0-9.a-z]*)")
_OWN = "insole-studio"
ROOT = Path(__file__).resolve().parents[2]
LICENCES = ROOT / "packaging" / "licences"
WITHOUT_TEXT = {
    "embreex": ("Apache-2.0.txt",),
    "qtawesome": ("Apache-2.0.txt",),
    "cvista": ("VTK.txt",),
    "cvista-rendering": ("VTK.txt",),
    "pyside6-essentials": ("LGPL-3.0.txt", "GPL-3.0.txt"),
    "shiboken6": ("LGPL-3.0.txt", "GPL-3.0.txt"),
}
"""Packages that come without the text of their licence, or of what is within: where it is."""
MANUAL_STATIC = re.compile(r"insole_core/_resources/manual/\w+/_static/(?P<file>.+)")
MANUAL_FILES = (
    ("*stemmer.js", "snowballstemmer"),
    ("pygments.css", "pygments"),
    ("debug.css", "sphinx-basic-ng"),
    ("skeleton.css", "sphinx-basic-ng"),
    ("s[ct]*/furo*", "furo"),
    ("*", "sphinx"),
)
"""Whose the scripts and styles of the manual's site are, which is made anew for each build."""
MANUAL_LIBRARIES = {"furo": (("gumshoejs", "5.1.2"),)}
"""Scripts of others within these, whose licences are in a file beside them."""
DOT_PATTERN = "insole_core/_resources/dot_pattern/*"
_LIBRARY_OF_VTK = re.compile(r"cvista/libvtk(?P<name>[a-z][a-z0-9]+)-cvista\.so")


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
    files: tuple[str, ...] = field(default=())
    """Places in the bundle."""


def components_of(sources: Iterable[tuple[str, str]], also: Iterable[str] = ()) -> list[Component]:
    """Return the works to which bundled files belong, by name.

    Parameters
    ----------
    sources
        Place of each file in the bundle, and the file it is made from.
    also
        Names of packages of which the bundle holds more than files.

    Raises
    ------
    LookupError
        When a file belongs to no known work, or one has no text of its licence: nothing may be
        passed on without.
    """
    found: dict[str, Component] = {_python().name: _python()}
    for name in also:
        found[name] = _of_package(name)
    files: dict[str, list[str]] = defaultdict(list)
    for place, source in sources:
        owner = _owner_of(place, source)
        if owner is not None:
            found.setdefault(owner.name, owner)
            files[owner.name].append(place)
    silent = [component.name for component in found.values() if not component.texts]
    if silent:
        raise LookupError(f"no text of a licence is known for {', '.join(silent)}")
    return [
        _with_files(component, files.get(component.name, []))
        for component in sorted(found.values(), key=lambda component: component.name.lower())
    ]


def unlisted(folder: Path, listed: Container[str]) -> list[str]:
    """Return the places of files in a frozen folder that nobody has looked at.

    Parameters
    ----------
    folder
        Of the libraries, so that places are relative to it.
    listed
        Places whose owner is known.
    """
    places = (
        path.relative_to(folder).as_posix()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and not path.is_symlink()
    )
    return [place for place in places if place not in listed]


def _owner_of(place: str, source: str) -> Component | None:
    """Return whose a file is; None if it is our own."""
    if match := MANUAL_STATIC.fullmatch(PurePath(place).as_posix()):
        names = (name for pattern, name in MANUAL_FILES if fnmatchcase(match["file"], pattern))
        return _of_package(next(names))
    if fnmatchcase(PurePath(place).as_posix(), DOT_PATTERN):
        return _dot_pattern()
    owner = _owners().get(source) or _owners().get(str(Path(source).resolve()))
    if owner is not None:
        is_own = _normal_name(owner.metadata["Name"]) == _OWN
        return None if is_own else _of_distribution(owner)
    if _is_of_python(Path(source)):
        return _python()
    if Path(source).resolve().is_relative_to(ROOT):
        return None
    return _of_debian(Path(source))


@cache
def _owners() -> dict[str, Distribution]:
    return {
        os.path.normpath(str(distribution.locate_file(file))): distribution
        for distribution in distributions()
        for file in distribution.files or []
    }


def _is_of_python(source: Path) -> bool:
    roots = [Path(sysconfig.get_path("stdlib"))]
    if sys.base_prefix != "/usr":  # which holds everything else, too
        roots.append(Path(sys.base_prefix))
    return source.name.startswith(("base_library.zip", "libpython")) or any(
        source.resolve().is_relative_to(root.resolve()) for root in roots
    )


def _normal_name(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


@cache
def _of_distribution(owner: Distribution) -> Component:
    metadata = metadata_of(owner)
    texts = [
        (PurePath(file).name, _text(Path(str(owner.locate_file(file)))))
        for file in owner.files or []
        if LICENCE_FILE.match(PurePath(file).name) and PurePath(file).suffix not in {".py", ".pyc"}
    ]
    name = _normal_name(metadata["Name"])
    texts += [(text, _text(LICENCES / text)) for text in WITHOUT_TEXT.get(name, ())]
    return Component(
        name,
        owner.version,
        "pypi",
        _licence(metadata),
        _homepage(metadata),
        tuple(texts),
    )


@cache
def _of_package(name: str) -> Component:
    return _of_distribution(distribution(name))


def metadata_of(owner: Distribution) -> Message:
    """Return what a package says of itself."""
    return message_from_string(owner.read_text("METADATA") or "")


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


@cache
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


@cache
def _python() -> Component:
    version = ".".join(str(part) for part in sys.version_info[:3])
    places = [
        Path(sys.base_prefix) / "lib" / f"python{version.rsplit('.', 1)[0]}" / "LICENSE.txt",
        Path(sys.base_prefix) / "LICENSE.txt",
    ]
    texts = tuple((path.name, _text(path)) for path in places if path.is_file())
    return Component("python", version, "generic", "PSF-2.0", "https://www.python.org", texts)


def _dot_pattern() -> Component:
    text = _text(ROOT / "resources" / "dot_pattern" / "LICENSE")
    home = "https://github.com/autonomousvision/connecting_the_dots"
    return Component("connecting-the-dots", "2019", "generic", "MIT", home, (("LICENSE", text),))


def _with_files(component: Component, files: Sequence[str]) -> Component:
    """Add the files, and the libraries of others among them.

    Those that a wheel copied carry a checksum in their names, those that VTK builds itself begin
    with a small letter.
    """
    libraries = {
        (match["name"], match["version"])
        for file in files
        if (match := _COPY_OF_LIBRARY.fullmatch(PurePath(file).name))
    }
    libraries |= {
        (match["name"], "")
        for file in files
        if (match := _LIBRARY_OF_VTK.fullmatch(PurePath(file).as_posix()))
    }
    libraries |= set(MANUAL_LIBRARIES.get(component.name, ()))
    return replace(component, libraries=tuple(sorted(libraries)), files=tuple(files))


def _output(*call: str) -> str:
    try:
        answer = subprocess.run(call, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return ""
    return answer.stdout if answer.returncode == 0 else ""


def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""
