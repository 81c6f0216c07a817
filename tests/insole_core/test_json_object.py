"""Every violation of a JSON file is one sentence that names the file and the key."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from insole_core.errors import InputError
from insole_core.geometry.side import Side
from insole_core.json_object import JsonObject

Read = Callable[[JsonObject], object]


def root(**values: Any) -> JsonObject:
    return JsonObject.parse("a.json", json.dumps(values).encode())


VIOLATIONS: list[tuple[Any, Read, str]] = [
    ("", lambda r: r.text("x"), "a.json: x must be a text that is not empty."),
    (3, lambda r: r.text("x"), "a.json: x must be a text."),
    (1, lambda r: r.flag("x"), "a.json: x is 1, but must be true or false."),
    (True, lambda r: r.number("x"), "a.json: x is true, but must be a number."),
    ("3", lambda r: r.number("x"), 'a.json: x is "3", but must be a number.'),
    (float("nan"), lambda r: r.number("x"), "a.json: x is nan, but must be a finite number."),
    (float("-inf"), lambda r: r.number("x"), "a.json: x is -inf, but must be a finite number."),
    (
        10**400,
        lambda r: r.number("x"),
        f"a.json: x is 1{'0' * 36}…, but must be a finite number.",
    ),
    (7, lambda r: r.number("x", 0, 5), "a.json: x is 7, but must lie between 0 and 5."),
    (1.5, lambda r: r.integer("x", 0, 5), "a.json: x is 1.5, but must be a whole number."),
    ("up", lambda r: r.choice("x", list(Side)), 'x is "up", but must be "left" or "right".'),
    (["left"], lambda r: r.choice("x", list(Side)), 'x is ["left"], but must be "left" or'),
    ({}, lambda r: r.items("x"), "a.json: x must be a list […]."),
    ([], lambda r: r.object("x"), "a.json: x must be an object {…}."),
    ([{}, 3], lambda r: r.objects("x"), "a.json: x[1] must be an object {…}."),
    ([{}], lambda r: r.objects("x")[0].text("y"), "a.json: x[0].y is missing."),
    ([1], lambda r: r.pair("x"), "a.json: x has 1 numbers, but must have 2."),
    ([1, 2, None], lambda r: r.triple("x"), "a.json: x[2] is null, but must be a number."),
    ([1, -2], lambda r: r.numbers("x", 2, 0), "a.json: x[1] is -2, but must lie between 0 and"),
    ([[1, 2], [1]], lambda r: r.vectors("x", 2), "a.json: x[1] has 1 numbers, but must have 2."),
    ([[1, 2]], lambda r: r.matrix("x", 2), "a.json: x must be a 2×2 matrix."),
    (
        {"y": [[1, "a"]]},
        lambda r: r.object("x").vectors("y", 2),
        'a.json: x.y[0][1] is "a", but must be a number.',
    ),
]


@pytest.mark.parametrize(("value", "read", "sentence"), VIOLATIONS, ids=range(len(VIOLATIONS)))
def test_violations(value: Any, read: Read, sentence: str) -> None:
    with pytest.raises(InputError) as caught:
        read(root(x=value))
    assert sentence in str(caught.value)


def test_what_is_right_is_given_as_it_is() -> None:
    values = root(side="left", count=4.0, empty="", place=[1, 2, 3], rows=[[1, 0], [0, 1]])
    assert values.choice("side", list(Side)) is Side.LEFT
    assert values.integer("count", 1, 5) == 4
    assert values.text("empty", empty=True) == ""
    assert values.triple("place") == (1.0, 2.0, 3.0)
    assert values.matrix("rows", 2) == [(1.0, 0.0), (0.0, 1.0)]


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({}, "a.json: format is missing."),
        ({"format": "other"}, "a.json: format is 'other', but must be \"mine\"."),
        ({"format": "mine"}, "a.json: version is missing."),
        ({"format": "mine", "version": 0}, "a.json: version is 0, but must lie between 1 and 2."),
        ({"format": "mine", "version": True}, "a.json: version is true, but must be a number."),
        ({"format": "mine", "version": 3}, "a.json is of version 3, which is newer than this"),
    ],
)
def test_formats(values: dict[str, Any], sentence: str) -> None:
    with pytest.raises(InputError) as caught:
        root(**values).check_format("mine", 2)
    assert sentence in str(caught.value)


@pytest.mark.parametrize("text", [b"", b"{", b"\xff", b"[" * 100_000, b'{"a": ' + b"1" * 5000])
def test_what_is_no_json_is_said(tmp_path: Path, text: bytes) -> None:
    path = tmp_path / "a.json"
    path.write_bytes(text)
    with pytest.raises(InputError, match=r"a\.json is not valid JSON .*; restore the file\."):
        JsonObject.read(path)


def test_a_file_that_cannot_be_read_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"none\.json cannot be read: .*; check the name of the"):
        JsonObject.read(tmp_path / "none.json")


def test_the_name_of_a_file_stays_as_it_is() -> None:
    content = JsonObject("a.json", {"path": "/scans/Eva\u00a0Ek\u202e.stl"})
    assert content.path_text("path") == "/scans/Eva\u00a0Ek\u202e.stl"
    assert content.text("path") != content.path_text("path")
