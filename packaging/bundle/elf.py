"""What the libraries of a Linux bundle ask of the system that runs them."""

from __future__ import annotations

import re
import subprocess
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

MAGIC = b"\x7fELF"
_NEEDED = re.compile(r"^\s+NEEDED\s+(\S+)", re.MULTILINE)
_SYMBOL_VERSION = re.compile(r"\b(GLIBC|GLIBCXX|CXXABI|GCC)_([0-9.]+)")
_LOAD = re.compile(r"LOAD off\s+0x([0-9a-f]+) vaddr 0x([0-9a-f]+) .* align 2\*\*(\d+)")

OLDEST_SYSTEMS = {"GLIBC": (2, 36), "GLIBCXX": (3, 4, 30), "CXXABI": (1, 3, 13), "GCC": (12, 0, 0)}
"""Of Debian 12. Ubuntu 24.04 has glibc 2.39 and GLIBCXX 3.4.33, Debian 13 has 2.41 and 3.4.33."""


@dataclass(frozen=True)
class ElfFile:
    """A program or library, and what it asks for."""

    path: Path
    needed: tuple[str, ...]
    """Names of the libraries it is linked to."""
    symbol_versions: tuple[tuple[str, tuple[int, ...]], ...]
    """Such as ``("GLIBC", (2, 34))``: what these libraries have to provide."""
    is_loadable: bool
    """Whether its parts lie where the system can map them; ``strip`` breaks that in some files."""


def elf_files(folder: Path) -> Iterator[Path]:
    """Yield the programs and libraries in a folder, without links to them."""
    for path in sorted(folder.rglob("*")):
        if path.is_file() and not path.is_symlink():
            with path.open("rb") as file:
                if file.read(4) == MAGIC:
                    yield path


def read_elf(path: Path) -> ElfFile:
    """Return what a program or library asks for."""
    call = ["objdump", "-p", str(path)]
    text = subprocess.run(call, capture_output=True, text=True, check=True).stdout
    _, _, references = text.partition("Version References:")
    versions = {
        (name, tuple(int(part) for part in numbers.strip(".").split(".")))
        for name, numbers in _SYMBOL_VERSION.findall(references)
    }
    segments = [
        (int(offset, 16), int(address, 16), 2 ** int(power))
        for offset, address, power in _LOAD.findall(text)
    ]
    loadable = all(offset % align == address % align for offset, address, align in segments)
    return ElfFile(path, tuple(_NEEDED.findall(text)), tuple(sorted(versions)), loadable)


def newest_versions(files: Iterable[ElfFile]) -> dict[str, tuple[tuple[int, ...], Path]]:
    """Return for each library of the system the newest version asked for, and by which file."""
    newest: dict[str, tuple[tuple[int, ...], Path]] = {}
    for file in files:
        for name, version in file.symbol_versions:
            if name not in newest or version > newest[name][0]:
                newest[name] = (version, file.path)
    return newest


def too_new(files: Iterable[ElfFile]) -> list[str]:
    """Return a sentence for each library that the oldest supported system could not load."""
    return [
        f"{file.path} asks for {name}_{'.'.join(map(str, version))}"
        for file in files
        for name, version in file.symbol_versions
        if version > OLDEST_SYSTEMS[name]
    ]


def of_the_system(files: Iterable[ElfFile], folder: Path) -> dict[str, list[Path]]:
    """Return the libraries that the bundle lacks, and who asks for them."""
    bundled = {path.name for path in folder.rglob("*")}
    asked: dict[str, list[Path]] = defaultdict(list)
    for file in files:
        for name in file.needed:
            if name not in bundled:
                asked[name].append(file.path)
    return dict(asked)
