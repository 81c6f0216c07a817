"""The folder with the program: PyInstaller, and what makes its result fit to be passed on."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from importlib.metadata import distribution
from pathlib import Path

from bundle import elf, product, shrink
from bundle.components import metadata_of, unlisted
from bundle.debian_packages import packages_for
from bundle.small_icu import shrink_icu_data
from bundle.version import version_of

MOST_MEBIBYTES = 500
"""Of the folder, as ``du -m`` counts."""
GENERATED = product.BUILD / "generated"


class UnfitError(Exception):
    """The bundle cannot be given to users; its text says why."""


def freeze() -> str:
    """Make ``dist/insole-studio``; return the version.

    Raises
    ------
    UnfitError
        When the result is too large, holds a file of unknown licence, or asks for what supported
        systems do not have.
    """
    version = version_of(product.ROOT)
    _write_metadata(version)
    subprocess.run([sys.executable, str(product.ROOT / "docs" / "build_manual.py")], check=True)
    shutil.rmtree(product.FROZEN, ignore_errors=True)
    environment = {
        **os.environ,
        "INSOLE_STUDIO_GENERATED": str(GENERATED),
        "INSOLE_STUDIO_VERSION": version,
    }
    call = [
        sys.executable, "-m", "PyInstaller", "--noconfirm", "--log-level", "WARN",
        "--distpath", str(product.DIST), "--workpath", str(product.BUILD / "pyinstaller"),
        str(product.PACKAGING / "insole-studio.spec"),
    ]  # fmt: skip
    subprocess.run(call, check=True, env=environment)
    _check_owners()
    shrink.reduce_pictures(_resources() / "manual")
    if sys.platform.startswith("linux"):
        for library in product.FROZEN.rglob("libicudata.so.*"):
            if not library.is_symlink():
                shrink_icu_data(library, product.BUILD / "icu")
        shrink.strip_libraries(product.FROZEN)
        shrink.link_duplicates(product.FROZEN)
        _check_libraries(product.FROZEN)
    size = shrink.size_of(product.FROZEN) / 2**20
    print(f"{product.FROZEN}: {version}, {size:.0f} MiB", flush=True)
    if size > MOST_MEBIBYTES:
        raise UnfitError(f"the program takes {size:.0f} MiB; {MOST_MEBIBYTES} are allowed")
    return version


def _resources() -> Path:
    return next(product.FROZEN.rglob("insole_core/_resources"))


def _write_metadata(version: str) -> None:
    """Write what the frozen program's own version is read from."""
    shutil.rmtree(GENERATED, ignore_errors=True)
    folder = GENERATED / f"insole_studio-{version}.dist-info"
    folder.mkdir(parents=True)
    metadata = metadata_of(distribution(product.COMMAND))
    del metadata["Version"]
    metadata["Version"] = version
    (folder / "METADATA").write_text(metadata.as_string(), encoding="utf-8")


def _check_owners() -> None:
    """Make sure that the bill of materials was made of all files that are there."""
    listed = set(json.loads((product.BUILD / "places.json").read_text(encoding="utf-8")))
    strangers = unlisted(product.FROZEN / "_internal", listed)
    if strangers:
        raise UnfitError(f"nobody knows whose these files are: {', '.join(strangers)}")


def _check_libraries(folder: Path) -> None:
    files = [elf.read_elf(path) for path in elf.elf_files(folder)]
    for name, (version, path) in sorted(elf.newest_versions(files).items()):
        print(f"needs {name} {'.'.join(map(str, version))} ({path.relative_to(folder)})")
    problems = elf.too_new(files)
    asked = elf.of_the_system(files, folder)
    packages, unknown = packages_for(asked)
    problems += [
        f"no package is known for {name}, for which {asked[name][0]} asks" for name in unknown
    ]
    (product.BUILD / "depends.json").write_text(json.dumps(packages), encoding="utf-8")
    if problems:
        raise UnfitError("\n".join(problems))
