"""The JSON form of a design: docs/formats/design.md. Refuses what it does not understand."""

from __future__ import annotations

import json
from dataclasses import MISSING, Field, fields
from pathlib import Path
from typing import Any, NoReturn

from insole_core.errors import DesignError, InputError
from insole_core.geometry.side import Side
from insole_core.insole.design import Correction, InsoleDesign, Pelott, Posting
from insole_core.insole.limits import check_design

FORMAT, VERSION = "insole-design", 1

_TYPES: dict[str, type[Correction]] = {Pelott.type: Pelott, Posting.type: Posting}
_PAIRS = ("centre_mm", "sigma_mm")
_TEXTS = ("id", "author", "created_at", "shape")


def read_design(path: Path) -> InsoleDesign:
    """Read a design file.

    Raises
    ------
    InputError
        Names the file, and the key that is missing, unknown or out of range.
    """
    try:
        content = json.loads(
            path.read_text(encoding="utf-8"),
            parse_constant=_refuse_constant,
            object_pairs_hook=_without_doubles,
        )
        return design_from_json(content)
    except OSError as error:
        raise InputError(
            f"{path} cannot be read: {error.strerror}; check the name of the file."
        ) from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path} is no UTF-8 text; hand in a design as JSON.") from error
    except (json.JSONDecodeError, RecursionError) as error:
        raise InputError(f"{path} is no valid JSON: {error}; export the design again.") from error
    except DesignError as error:
        raise InputError(f"{path}: {error}") from error


def design_to_json(design: InsoleDesign) -> dict[str, Any]:
    """Give a design as plain values for `json.dump`."""
    values = {f.name: getattr(design, f.name) for f in fields(design)}
    return {
        "format": FORMAT,
        "version": VERSION,
        **values,
        "side": str(design.side),
        "corrections": [_correction_to_json(c) for c in design.corrections],
    }


def design_from_json(content: Any) -> InsoleDesign:
    """Build a design from what `json.load` gave.

    Raises
    ------
    DesignError
        One sentence that names the key.
    """
    top = _object(content, "the design")
    if top.get("format") != FORMAT:
        raise DesignError(f'format must be "{FORMAT}"; this is no design of an insole.')
    _check_version(top.get("version"))
    allowed = {f.name for f in fields(InsoleDesign)}
    _check_keys(top, allowed | {"format", "version"}, {"side", "corrections"}, "the design")
    if not isinstance(top["corrections"], list):
        raise DesignError("corrections must be a list; put the corrections in [ ].")
    numbers = {key: _number(top[key], key) for key in allowed & top.keys() if key.endswith("_mm")}
    design = InsoleDesign(
        side=_side(top["side"]),
        corrections=tuple(_correction(c, n) for n, c in enumerate(top["corrections"])),
        **numbers,
    )
    check_design(design)
    return design


def _correction_to_json(correction: Correction) -> dict[str, Any]:
    values = {f.name: getattr(correction, f.name) for f in fields(correction)}
    plain = {k: list(v) if isinstance(v, tuple) else v for k, v in values.items()}
    return {"type": correction.type, **{k: v for k, v in plain.items() if v is not None}}


def _correction(content: Any, number: int) -> Correction:
    where = f"corrections[{number}]"
    given = dict(_object(content, where))
    name = given.pop("type", None)
    if not isinstance(name, str) or name not in _TYPES:
        known = ", ".join(f'"{known}"' for known in _TYPES)
        raise DesignError(
            f"{where} is of the type {json.dumps(name)}, which this version does not know;"
            f" it knows {known}."
        )
    kind = _TYPES[name]
    described: dict[str, Field[Any]] = {f.name: f for f in fields(kind)}
    required = {
        k for k, f in described.items() if f.default is MISSING and f.default_factory is MISSING
    }
    _check_keys(given, set(described), required, f"{where} ({name})")
    return kind(**{k: _value(k, v, f"{k} of {where} ({name})") for k, v in given.items()})


def _value(key: str, value: Any, where: str) -> Any:
    if key in _TEXTS:
        if not isinstance(value, str):
            raise DesignError(f"{where} must be a text; write it in quotation marks.")
        return value
    if key == "enabled":
        if not isinstance(value, bool):
            raise DesignError(f"{where} must be true or false.")
        return value
    if key in _PAIRS:
        if not isinstance(value, list) or len(value) != 2:
            raise DesignError(f"{where} must be two numbers in [ ].")
        return tuple(_number(part, where) for part in value)
    return _number(value, where)


def _number(value: Any, where: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise DesignError(f"{where} must be a number, and is {json.dumps(value)[:60]}.")
    try:
        return float(value)
    except OverflowError as error:
        raise DesignError(f"{where} is too large a number; put in a usual one.") from error


def _side(value: Any) -> Side:
    if value not in ("left", "right"):
        raise DesignError(f'side must be "left" or "right", and is {json.dumps(value)[:60]}.')
    return Side(value)


def _object(content: Any, where: str) -> dict[str, Any]:
    if not isinstance(content, dict):
        raise DesignError(f"{where} must be a JSON object, with keys and values in {{ }}.")
    return content


def _check_version(version: Any) -> None:
    if isinstance(version, bool) or not isinstance(version, int) or version < 1:
        raise DesignError(f"version must be {VERSION}, and is {json.dumps(version)[:60]}.")
    if version > VERSION:
        raise DesignError(
            f"this design is of version {version}, and this program reads up to version {VERSION};"
            " install a newer Insole Studio."
        )


def _check_keys(given: dict[str, Any], allowed: set[str], required: set[str], where: str) -> None:
    for key in sorted(required - given.keys()):
        raise DesignError(f'{where} lacks the key "{key}"; add it.')
    for key in sorted(given.keys() - allowed):
        raise DesignError(
            f'{where} has the key "{key}", which this version does not know;'
            " check its spelling or leave it out."
        )


def _refuse_constant(name: str) -> NoReturn:
    raise DesignError(f"{name} is no number a design can hold; put in a usual one.")


def _without_doubles(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    content = dict(pairs)
    if len(content) < len(pairs):
        keys = [key for key, _ in pairs]
        twice = next(key for key in keys if keys.count(key) > 1)
        raise DesignError(f'the key "{twice}" stands twice in one object; keep one.')
    return content
