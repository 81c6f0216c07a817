"""A smaller copy of the tables of Unicode that Qt brings on Linux.

Qt itself knows languages, numbers, dates and time zones, and asks ICU for the order of texts and
the case of letters. Names of regions, currencies and units in 500 languages, transliteration, and
encodings of the 1980s are 30 MB of the library.
"""

from __future__ import annotations

import subprocess
from pathlib import Path

KEPT_FOLDERS = ("coll",)
KEPT_LOCALES = ("root.res", "en.res", "sv.res")
ASSEMBLY = """\
.section .rodata
.balign 16
.global {symbol}
.type {symbol}, @object
{symbol}:
.incbin "{data}"
.size {symbol}, .-{symbol}
.section .note.GNU-stack,"",@progbits
"""


def is_kept(item: str) -> bool:
    """Say whether an item of ICU's data stays, for example ``curr/sv.res``."""
    folder, _, name = item.rpartition("/")
    if folder:
        return folder in KEPT_FOLDERS
    if name.endswith((".cnv", ".spp", ".cfu")):
        return False
    return not _is_locale(name) or name in KEPT_LOCALES


def _is_locale(name: str) -> bool:
    """Tell ``pt_BR.res`` from tables for all languages, such as ``supplementalData.res``."""
    language = name.partition(".")[0].partition("_")[0]
    return name.endswith(".res") and 2 <= len(language) <= 3 and language.islower()


def shrink_icu_data(library: Path, workplace: Path) -> None:
    """Replace ICU's data library by one with what Qt asks for.

    It needs ``icupkg`` (icu-devtools), and ``gcc`` as assembler.
    """
    symbol = _output("nm", "-D", "--defined-only", str(library)).split()[-1]
    name = f"{symbol.removesuffix('_dat')}l.dat"  # icupkg takes no other: l is for little-endian
    whole, part = workplace / "whole" / name, workplace / "part" / name
    for path in (whole, part):
        path.parent.mkdir(parents=True, exist_ok=True)
    _run("objcopy", "-O", "binary", "--only-section=.rodata", str(library), str(whole))
    items = _output("icupkg", "--list", str(whole)).split()
    removed = workplace / "removed.txt"
    removed.write_text("".join(f"{item}\n" for item in items if not is_kept(item)))
    _run("icupkg", "--remove", str(removed), str(whole), str(part))
    source = workplace / "data.s"
    source.write_text(ASSEMBLY.format(symbol=symbol, data=part))
    _run(
        "gcc", "-shared", "-nostdlib", f"-Wl,-soname,{library.name}", "-Wl,-z,noexecstack",
        "-o", str(library), str(source),
    )  # fmt: skip


def _run(*call: str) -> None:
    subprocess.run(call, check=True)


def _output(*call: str) -> str:
    return subprocess.run(call, capture_output=True, text=True, check=True).stdout
