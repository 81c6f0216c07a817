"""Makes a frozen folder smaller without changing what it does."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections import defaultdict
from pathlib import Path

from bundle.checksums import sha256_of
from bundle.elf import elf_files, read_elf

SMALLEST_DUPLICATE = 16 * 1024
"""Bytes; a link saves nothing below."""
MANUAL_COLOURS = 256


def strip_libraries(folder: Path) -> int:
    """Remove the symbols that only a debugger reads; return the bytes saved."""
    saved = 0
    for path in elf_files(folder):
        stripped = path.with_name(path.name + ".stripped")
        call = ["strip", "--strip-unneeded", "-o", str(stripped), str(path)]
        done = subprocess.run(call, capture_output=True, check=False).returncode == 0
        before = path.stat().st_size
        if done and stripped.stat().st_size < before and read_elf(stripped).is_loadable:
            shutil.copymode(path, stripped)
            saved += before - stripped.stat().st_size
            stripped.replace(path)
        else:
            stripped.unlink(missing_ok=True)
    return saved


def link_duplicates(folder: Path) -> int:
    """Make links of files with the same content; return the bytes saved."""
    by_size: dict[int, list[Path]] = defaultdict(list)
    for path in sorted(folder.rglob("*")):
        if path.is_file() and not path.is_symlink():
            by_size[path.stat().st_size].append(path)
    first: dict[str, Path] = {}
    saved = 0
    for size, paths in by_size.items():
        if size < SMALLEST_DUPLICATE or len(paths) == 1:
            continue
        for path in paths:
            digest = sha256_of(path)
            if digest not in first:
                first[digest] = path
                continue
            path.unlink()
            path.symlink_to(os.path.relpath(first[digest], path.parent))
            saved += size
    return saved


def reduce_pictures(folder: Path) -> int:
    """Reduce pictures to the 256 colours that each needs most; return the bytes saved."""
    from PIL import Image

    saved = 0
    for path in sorted(folder.rglob("*.png")):
        small = path.with_name(path.name + ".small")
        with Image.open(path) as picture:
            colours = picture.convert("RGB").quantize(MANUAL_COLOURS)
        colours.save(small, format="PNG", optimize=True)
        before, after = path.stat().st_size, small.stat().st_size
        if after < before:
            saved += before - after
            small.replace(path)
        else:
            small.unlink()
    return saved


def size_of(folder: Path) -> int:
    """Return the bytes of all files in a folder."""
    return sum(
        path.stat().st_size
        for path in folder.rglob("*")
        if path.is_file() and not path.is_symlink()
    )
