"""Strict JSON: every wrong or missing value is one sentence that names the file and the key."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from insole_core.errors import InputError
from insole_core.messages import Message, Value


@dataclass(frozen=True)
class JsonObject:
    """An object inside a JSON file that knows where it stands.

    Parameters
    ----------
    file
        Name of the file, for messages.
    values
    place
        Keys that lead here from the root, for messages, such as ``depth_camera.``.
    """

    file: str
    values: dict[str, Any]
    place: str = ""

    @classmethod
    def parse(cls, file: str, text: bytes) -> JsonObject:
        """Read the root object of a JSON file.

        Raises
        ------
        InputError
            When the text is no JSON object.
        """
        try:
            values = json.loads(text)
        except (ValueError, RecursionError) as error:
            raise InputError(
                "{file} is not valid JSON ({reason}); restore the file.",
                file=file,
                reason=str(error),
            ) from error
        if not isinstance(values, dict):
            raise InputError("{file} must hold one JSON object {{…}}; restore the file.", file=file)
        return cls(file, values)

    def fail(self, key: str, problem: str, /, **values: Value) -> InputError:
        """Make the error for one key; template and values as those of a `Message`."""
        return InputError(
            "{file}: {key} {problem}.",
            file=self.file,
            key=f"{self.place}{key}",
            problem=Message(problem, **values),
        )

    def has(self, key: str) -> bool:
        """Whether the key is there at all."""
        return key in self.values

    def value(self, key: str) -> Any:
        """Give a value of any type."""
        if key not in self.values:
            raise self.fail(key, "is missing")
        return self.values[key]

    def object(self, key: str) -> JsonObject:
        """Give a nested object."""
        return self._nested(key, self.value(key))

    def objects(self, key: str) -> list[JsonObject]:
        """Give a list of objects."""
        return [self._nested(f"{key}[{i}]", item) for i, item in enumerate(self.items(key))]

    def items(self, key: str) -> list[Any]:
        """Give a list of anything."""
        value = self.value(key)
        if not isinstance(value, list):
            raise self.fail(key, "must be a list […]")
        return value

    def text(self, key: str) -> str:
        """Give a string that is not empty."""
        value = self.value(key)
        if not isinstance(value, str) or not value:
            raise self.fail(key, "must be a text that is not empty")
        return value

    def choice(self, key: str, allowed: Sequence[str]) -> str:
        """Give one of a few words."""
        value = self.value(key)
        if value not in allowed:
            raise self.fail(
                key,
                "is {value}, but must be {allowed}",
                value=_short(value),
                allowed=_alternatives(allowed),
            )
        return str(value)

    def flag(self, key: str) -> bool:
        """Give true or false."""
        value = self.value(key)
        if not isinstance(value, bool):
            raise self.fail(key, "is {value}, but must be true or false", value=_short(value))
        return value

    def number(self, key: str, low: float = -math.inf, high: float = math.inf) -> float:
        """Give a finite number from `low` to `high`."""
        return self._number(key, self.value(key), low, high)

    def integer(self, key: str, low: int, high: int) -> int:
        """Give a whole number from `low` to `high`."""
        number = self.number(key, low, high)
        if number != int(number):
            raise self.fail(key, "is {value}, but must be a whole number", value=number)
        return int(number)

    def numbers(self, key: str, count: int) -> tuple[float, ...]:
        """Give a list of exactly `count` finite numbers."""
        values = self.items(key)
        if len(values) != count:
            raise self.fail(
                key, "has {found} numbers, but must have {count}", found=len(values), count=count
            )
        return tuple(
            self._number(f"{key}[{i}]", value, -math.inf, math.inf)
            for i, value in enumerate(values)
        )

    def _nested(self, key: str, value: Any) -> JsonObject:
        if not isinstance(value, dict):
            raise self.fail(key, "must be an object {…}")
        return JsonObject(self.file, value, f"{self.place}{key}.")

    def _number(self, key: str, value: Any, low: float, high: float) -> float:
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise self.fail(key, "is {value}, but must be a number", value=_short(value))
        if not math.isfinite(value):
            raise self.fail(key, "is {value}, but must be a finite number", value=value)
        if not low <= value <= high:
            raise self.fail(
                key,
                "is {value}, but must lie between {least:g} and {most:g}",
                value=value,
                least=low,
                most=high,
            )
        return float(value)


def _short(value: Any) -> str:
    text = json.dumps(value, ensure_ascii=False)
    return text if len(text) <= 40 else f"{text[:37]}…"


def _alternatives(words: Sequence[str]) -> str:
    quoted = [f'"{word}"' for word in words]
    return " or ".join([", ".join(quoted[:-1]), quoted[-1]]) if len(quoted) > 1 else quoted[0]
