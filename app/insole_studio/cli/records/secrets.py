"""Passwords and passphrases on the command line: asked for, or read from a file."""

from __future__ import annotations

import argparse
import getpass
import sys
from pathlib import Path

from insole_core.errors import InputError, UsageError
from insole_core.given_file import read_given

_MOST_BYTES = 2**16


def add_secret_arguments(parser: argparse.ArgumentParser) -> None:
    """Add where the passphrase or the private key of a backup is."""
    parser.add_argument(
        "--passphrase-file", type=Path, metavar="FILE",
        help="file with the passphrase of the backup; without it you are asked",
    )  # fmt: skip
    parser.add_argument(
        "--private-key", type=Path, metavar="FILE",
        help="file with the private key of age that the backup is for, instead of a passphrase",
    )  # fmt: skip


def secret_of(arguments: argparse.Namespace) -> str:
    """Return what opens a backup."""
    if arguments.private_key is None:
        return ask("Passphrase of the backup: ", arguments.passphrase_file)
    lines = _read(arguments.private_key).splitlines()
    keys = [line.strip() for line in lines if line.startswith("AGE-SECRET-KEY-")]
    if not keys:
        raise InputError(
            "{path} holds no private key of age; give the file that age-keygen has written.",
            path=arguments.private_key,
        )
    return keys[0]


def ask(prompt: str, file: Path | None) -> str:
    """Return a secret from a file, from whoever sits at the terminal, or from standard input.

    Raises
    ------
    UsageError
        When there is none.
    """
    if file is not None:
        return _read(file).rstrip("\r\n")
    if sys.stdin.isatty():
        return getpass.getpass(prompt)
    line = sys.stdin.readline().rstrip("\r\n")
    if not line:
        raise UsageError("Nobody can be asked for the passphrase; give the file that holds it.")
    return line


def _read(file: Path) -> str:
    try:
        return read_given(file, _MOST_BYTES).decode("utf-8")
    except UnicodeDecodeError as error:
        raise InputError("{path} is no text; give a file in UTF-8.", path=file) from error
