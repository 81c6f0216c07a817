"""Passwords and passphrases on the command line: asked for, or read from a file."""

from __future__ import annotations

import argparse
import getpass
import os
import sys
from pathlib import Path

from insole_core.errors import InputError, UsageError
from insole_core.given_file import read_given

_MOST_BYTES = 2**16


def add_secret_arguments(parser: argparse.ArgumentParser) -> None:
    """Add where the passphrase or the private key of a backup is."""
    secret = parser.add_mutually_exclusive_group()
    secret.add_argument(
        "--passphrase-file", type=Path, metavar="FILE",
        help="file with the passphrase of the backup; without it you are asked",
    )  # fmt: skip
    secret.add_argument(
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


def password_of(arguments: argparse.Namespace) -> str:
    """Return the password of the account that the options name; never an argument or a variable.

    Raises
    ------
    InputError
        When others may read the file with the password.
    UsageError
        When there is none.
    """
    if arguments.password_fd is not None:
        return _read_descriptor(arguments.password_fd)
    if arguments.password_file is not None:
        _check_private(arguments.password_file)
    return ask(f"Password of {arguments.account}: ", arguments.password_file)


def new_password(what: str = "Your own password") -> str:
    """Return a new password, which is asked for twice at a terminal, where nobody sees it.

    Raises
    ------
    UsageError
        When both differ, or nobody can be asked.
    """
    return ask_twice(f"{what}: ", "The two passwords differ; begin again.")


def ask_twice(prompt: str, differ: str) -> str:
    """Return a new secret: what is typed blindly is typed again, what a script writes is not.

    Raises
    ------
    UsageError
        When both differ, with `differ`, or nobody can be asked.
    """
    secret = ask(prompt, None)
    if sys.stdin.isatty() and ask("The same again: ", None) != secret:
        raise UsageError(differ)
    return secret


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
        raise UsageError(
            f"Nobody can be asked for: {prompt.strip(' :')}; give the file that holds it, or write "
            "it to the standard input."
        )
    return line


def _read_descriptor(number: int) -> str:
    try:
        with os.fdopen(os.dup(number), encoding="utf-8") as stream:
            return stream.readline(_MOST_BYTES).rstrip("\r\n")
    except (OSError, OverflowError, UnicodeDecodeError) as error:
        raise UsageError(
            f"The file descriptor {number} of --password-fd holds no text that can be read; open "
            "it before the command begins."
        ) from error


def _check_private(file: Path) -> None:
    """Refuse a password that others may read; Windows has no such bits, and reports none."""
    if os.name == "posix" and file.exists() and file.stat().st_mode & 0o077:
        raise InputError(
            "{path} holds a password, and others may read it; take that right from them (chmod "
            "600), and choose another password.",
            path=file,
        )


def _read(file: Path) -> str:
    try:
        return read_given(file, _MOST_BYTES).decode("utf-8")
    except UnicodeDecodeError as error:
        raise InputError("{path} is no text; give a file in UTF-8.", path=file) from error
