"""Arguments that name files to write, and the check that none of them is also read."""

from __future__ import annotations

import argparse
import errno
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from insole_core.errors import UsageError
from insole_core.geometry.side import Side


class OutputPath(argparse.Action):
    """Stores the path or paths of results, and notes that the argument names some."""

    def __init__(self, option_strings: Sequence[str], dest: str, **more: Any) -> None:
        super().__init__(option_strings, dest, type=Path, **more)

    def __call__(
        self,
        _parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: str | Sequence[Any] | None,
        _option: str | None = None,
    ) -> None:
        """Store the value."""
        setattr(namespace, self.dest, values)
        namespace.outputs = {*getattr(namespace, "outputs", ()), self.dest}


def check_texts(arguments: argparse.Namespace) -> None:
    """Check that all that was given is text, and that every path can be the name of a file.

    Raises
    ------
    UsageError
        Names the first that is not.
    """
    for value in vars(arguments).values():
        for text in value if isinstance(value, list | tuple) else [value]:
            if isinstance(text, str) and not _is_text(text):
                raise UsageError(f"{text} holds bytes that are no letters; type it again.")
        for path in _paths(value):
            try:
                path.lstat()
            except OSError as error:
                if error.errno == errno.ENAMETOOLONG:
                    raise UsageError(
                        f"{path} is too long for the name of a file; choose a shorter one."
                    ) from error


def _is_text(text: str) -> bool:
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def check_paths(arguments: argparse.Namespace) -> None:
    """Check that the command writes nothing that it reads.

    Raises
    ------
    UsageError
        Names the file.
    """
    written: set[str] = getattr(arguments, "outputs", set())
    if not written:
        return
    from insole_core.workflows.overwriting import check_overwriting

    outputs = [path for name in written for path in _paths(vars(arguments)[name])]
    inputs = [
        path for name, value in vars(arguments).items() if name not in written
        for path in _paths(value)
    ]  # fmt: skip
    check_overwriting(outputs, inputs)


def _paths(value: object) -> Iterator[Path]:
    if isinstance(value, Path):
        yield value
    elif isinstance(value, list | tuple):
        for part in value:
            yield from _paths(part)


def side_path(path: Path, side: Side, sides: Sequence[Side]) -> Path:
    """Return where the result of a foot goes: of two feet, the name says which one."""
    return path if len(sides) == 1 else path.with_name(f"{path.stem}_{side}{path.suffix}")
