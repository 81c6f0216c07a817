"""Strict JSON: every wrong or missing value is one sentence that names the file and the key.

Not msgspec or pydantic: what is read becomes arrays and values of other shapes, so their models
make the readers longer; msgspec reports neither the wrong value nor the key of a map, and pydantic
takes 0.1 s to load.
"""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any, TypeVar

from insole_core.errors import InputError
from insole_core.given_file import read_given
from insole_core.messages import Message, Value
from insole_core.strict_json import MOST_BYTES, load_strictly
from insole_core.visible_text import visible

_Word = TypeVar("_Word", bound=str)


@dataclass(frozen=True)
class JsonObject:
    """An object inside a JSON file, with its path from the root for error messages.

    Every getter raises an `InputError` that names file and key when the value is missing or is not
    what the getter asks for.

    Parameters
    ----------
    file
        Name of the file, for messages.
    place
        Keys that lead here from the root, for messages, such as ``depth_camera.``.
    """

    file: str
    values: dict[str, Any]
    place: str = ""

    @classmethod
    def read(cls, path: Path) -> JsonObject:
        """Read the root object of a JSON file.

        Raises
        ------
        InputError
            When the file cannot be read, or holds no JSON object.
        """
        return cls.parse(str(path), read_given(path, MOST_BYTES))

    @classmethod
    def parse(cls, file: str, text: bytes) -> JsonObject:
        """Read the root object of a JSON text.

        Parameters
        ----------
        file
            Name of the file, for messages.

        Raises
        ------
        InputError
            When the text is not a JSON object.
        """
        try:
            values = load_strictly(text)
        except InputError as error:
            raise InputError("{file}: {reason}", file=file, reason=error.message) from error
        except (ValueError, RecursionError) as error:
            raise InputError(
                "{file} is not valid JSON ({reason}); restore the file.",
                file=file,
                reason=str(error),
            ) from error
        if not isinstance(values, dict):
            raise InputError("{file} must hold one JSON object {{…}}; restore the file.", file=file)
        return cls(file, values)

    def check_format(self, name: str, newest: int = 1) -> int:
        """Check ``format`` and ``version``.

        Parameters
        ----------
        name
            The required format.
        newest
            The newest version that this program reads.

        Returns
        -------
        int
            Version of the file, 1 to `newest`.

        Raises
        ------
        InputError
            When it is of another format, or of a newer version.
        """
        if self.value("format") != name:
            raise self.fail(
                "format",
                'is {value!r}, but must be "{wanted}"',
                value=self.value("format"),
                wanted=name,
            )
        version = self.value("version")
        if isinstance(version, int) and version > newest:
            where = f"{self.file}: {self.place}".removesuffix(".").removesuffix(": ")
            raise InputError(
                "{where} is of version {version}, which is newer than this program (it reads up to "
                "{newest}); install a newer Insole Studio.",
                where=where,
                version=version,
                newest=newest,
            )
        return self.integer("version", 1, newest)

    def fail(self, key: str, problem: str, /, **values: Value) -> InputError:
        """Return the error for one key, for the caller to raise.

        Parameters
        ----------
        problem
            Template of the rest of the sentence, such as ``"is {value}, but must be …"``.
        values
            Of the template, as for `Message`.
        """
        return InputError(
            "{file}: {key} {problem}.",
            file=self.file,
            key=f"{self.place}{key}",
            problem=Message(problem, **values),
        )

    def has(self, key: str) -> bool:
        """Return whether the key exists."""
        return key in self.values

    def value(self, key: str) -> Any:
        """Return a value of any type."""
        if key not in self.values:
            raise self.fail(key, "is missing")
        return self.values[key]

    def object(self, key: str) -> JsonObject:
        """Return a nested object."""
        value = self.value(key)
        if not isinstance(value, dict):
            raise self.fail(key, "must be an object {…}")
        return JsonObject(self.file, value, f"{self.place}{key}.")

    def objects(self, key: str) -> list[JsonObject]:
        """Return a list of objects."""
        listed = self.listed(key)
        return [listed.object(number) for number in listed.values]

    def listed(self, key: str) -> JsonObject:
        """Return a list as an object with the keys ``[0]``, ``[1]`` …"""
        values = {f"[{i}]": item for i, item in enumerate(self.items(key))}
        return JsonObject(self.file, values, f"{self.place}{key}")

    def items(self, key: str) -> list[Any]:
        """Return a list of values of any type."""
        value = self.value(key)
        if not isinstance(value, list):
            raise self.fail(key, "must be a list […]")
        return value

    def text(self, key: str, *, empty: bool = False) -> str:
        """Return a string as it may be shown (`visible`); an empty one only with `empty`."""
        return visible(self.path_text(key, empty=empty))

    def path_text(self, key: str, *, empty: bool = False) -> str:
        """Return the name of a file as it is, by which it is found; `Message` makes it visible."""
        value = self.value(key)
        if not isinstance(value, str):
            raise self.fail(key, "must be a text")
        if not (value or empty):
            raise self.fail(key, "must be a text that is not empty")
        return value

    def date(self, key: str) -> str:
        """Return a date, with or without a time, as ISO 8601."""
        text = self.text(key)
        try:
            datetime.fromisoformat(text)
        except ValueError:
            raise self.fail(
                key, 'is "{text}", but must be a date such as 2026-11-20T10:00:00Z', text=_cut(text)
            ) from None
        return text

    def choice(self, key: str, allowed: Sequence[_Word]) -> _Word:
        """Return a string that must be one of `allowed`, as that item (a member of a `StrEnum`)."""
        value = self.value(key)
        if isinstance(value, str):
            value = visible(value)  # as `text` gives the words of the same file
        if value not in allowed:
            raise self.fail(
                key,
                "is {value}, but must be {allowed}",
                value=_short(value),
                allowed=_alternatives(allowed),
            )
        return allowed[allowed.index(value)]

    def flag(self, key: str) -> bool:
        """Return a boolean."""
        value = self.value(key)
        if not isinstance(value, bool):
            raise self.fail(key, "is {value}, but must be true or false", value=_short(value))
        return value

    def number(self, key: str, low: float = -math.inf, high: float = math.inf) -> float:
        """Return a finite number from `low` to `high`, both included."""
        value = self.value(key)
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise self.fail(key, "is {value}, but must be a number", value=_short(value))
        if not abs(value) <= sys.float_info.max:
            raise self.fail(key, "is {value}, but must be a finite number", value=_cut(str(value)))
        if not low <= value <= high:
            raise self.fail(
                key,
                "is {value}, but must lie between {least:g} and {most:g}",
                value=_cut(str(value)),
                least=low,
                most=high,
            )
        return float(value)

    def integer(self, key: str, low: int, high: int) -> int:
        """Return an integer from `low` to `high`, both included."""
        number = self.number(key, low, high)
        if number != int(number):
            raise self.fail(key, "is {value}, but must be a whole number", value=number)
        return int(number)

    def numbers(
        self, key: str, count: int, low: float = -math.inf, high: float = math.inf
    ) -> tuple[float, ...]:
        """Return a list of exactly `count` finite numbers from `low` to `high`, both included."""
        listed = self.listed(key)
        if len(listed.values) != count:
            raise self.fail(
                key,
                "has {found} numbers, but must have {count}",
                found=len(listed.values),
                count=count,
            )
        return tuple(listed.number(number, low, high) for number in listed.values)

    def pair(self, key: str, most: float = math.inf) -> tuple[float, float]:
        """Return a list of two finite numbers from -`most` to `most`."""
        u, v = self.numbers(key, 2, -most, most)
        return u, v

    def triple(self, key: str, most: float = math.inf) -> tuple[float, float, float]:
        """Return a list of three finite numbers from -`most` to `most`."""
        x, y, z = self.numbers(key, 3, -most, most)
        return x, y, z

    def texts(self, key: str) -> list[str]:
        """Return a list of strings."""
        listed = self.listed(key)
        return [listed.text(number, empty=True) for number in listed.values]

    def vectors(self, key: str, count: int) -> list[tuple[float, ...]]:
        """Return a list of lists of exactly `count` finite numbers each."""
        listed = self.listed(key)
        return [listed.numbers(number, count) for number in listed.values]

    def matrix(self, key: str, size: int) -> list[tuple[float, ...]]:
        """Return the rows of a `size` × `size` matrix of finite numbers."""
        if len(self.items(key)) != size:
            raise self.fail(key, "must be a {size}×{size} matrix", size=size)
        return self.vectors(key, size)


def _short(value: Any) -> str:
    return _cut(json.dumps(value, ensure_ascii=False))


def _cut(text: str) -> str:
    return text if len(text) <= 40 else f"{text[:37]}…"


def _alternatives(words: Sequence[str]) -> str:
    quoted = [f'"{word}"' for word in words]
    return " or ".join([", ".join(quoted[:-1]), quoted[-1]]) if len(quoted) > 1 else quoted[0]
