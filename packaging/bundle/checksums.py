"""Checksums of what is published, and their signature."""

from __future__ import annotations

import hashlib
import subprocess
from collections.abc import Iterable
from pathlib import Path

FILE = "SHA256SUMS"


def sha256_of(path: Path) -> str:
    """Return the SHA-256 of a file, in hexadecimal digits."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def write_checksums(files: Iterable[Path], folder: Path) -> Path:
    """Write the file that ``sha256sum --check`` reads; return it."""
    lines = [f"{sha256_of(path)}  {path.name}\n" for path in sorted(files)]
    target = folder / FILE
    target.write_text("".join(lines), encoding="ascii")
    return target


def sign(checksums: Path, key: str) -> None:
    """Sign the checksums with a key of GnuPG, or with minisign if the key is a file.

    Raises
    ------
    subprocess.CalledProcessError
        When the key cannot be used.
    """
    if Path(key).is_file():
        subprocess.run(["minisign", "-S", "-s", key, "-m", str(checksums)], check=True)
    else:
        call = ["gpg", "--batch", "--yes", "--local-user", key, "--armor", "--detach-sign"]
        subprocess.run([*call, str(checksums)], check=True)
