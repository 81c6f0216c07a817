"""The JSON form of a design: docs/formats/design.md. Anything unknown is refused."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import MISSING, Field, fields, is_dataclass
from pathlib import Path
from typing import Any, NoReturn, get_args

from insole_core.errors import DesignError, InputError
from insole_core.geometry.side import Side
from insole_core.given_file import read_given
from insole_core.insole.elements import CORRECTION_TYPES, Correction
from insole_core.insole.fields import Place, types_of
from insole_core.insole.prescription.base_form import Form
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_limits import check_design, check_form
from insole_core.insole.prescription.design_totals import check_totals
from insole_core.insole.prescription.item_name import checked_name
from insole_core.messages import Message
from insole_core.strict_json import MOST_BYTES, load_strictly

FORMAT, VERSION = "insole-design", 1

_MOST_STORED = 1000  # more than can be built, so that whatever was edited can be opened again


def read_design(path: Path) -> InsoleDesign:
    """Read a design file.

    Raises
    ------
    InputError
        Naming the file, and the key that is missing, unknown or out of range, or the total.
    """
    text = read_given(path, MOST_BYTES)
    try:
        design = design_from_json(load_strictly(text, parse_constant=_refuse_constant))
        check_totals(design)
        return design
    except UnicodeDecodeError as error:
        raise InputError("{path} is no UTF-8 text; hand in a design as JSON.", path=path) from error
    except (ValueError, RecursionError) as error:
        raise InputError(
            "{path} is no valid JSON: {reason}; export the design again.",
            path=path,
            reason=str(error),
        ) from error
    except (DesignError, InputError) as error:
        raise InputError("{path}: {reason}", path=path, reason=str(error)) from error


def design_to_json(design: InsoleDesign) -> dict[str, Any]:
    """Return a design as plain values for `json.dump`."""
    return {
        "format": FORMAT,
        "version": VERSION,
        **_to_json(design),
        "side": str(design.side),
        "corrections": [{"type": c.type, **_to_json(c)} for c in design.corrections],
    }


def design_from_json(content: Any) -> InsoleDesign:
    """Build a design from the result of `json.load`.

    Its totals are not checked: a case with a design that cannot be built opens, and says so.

    Raises
    ------
    DesignError
        One sentence that names the key.
    """
    top = dict(_object(content, "the design"))
    if top.pop("format", None) != FORMAT:
        raise DesignError(
            'format must be "{format}"; this is no design of an insole.', format=FORMAT
        )
    _check_version(top.pop("version", None))
    _check_keys(top, InsoleDesign, "the design")
    corrections = top.pop("corrections", None)
    if not isinstance(corrections, list):
        raise DesignError("corrections must be a list; put the corrections in [ ].")
    if len(corrections) > _MOST_STORED:
        raise DesignError(
            "corrections holds {count} of them, and may hold {most}; remove some.",
            count=len(corrections),
            most=_MOST_STORED,
        )
    design = InsoleDesign(
        side=_side(top.pop("side")),
        corrections=tuple(_correction(c, n) for n, c in enumerate(corrections)),
        **{key: _value(types_of(InsoleDesign)[key], value, key) for key, value in top.items()},
    )
    check_design(design)
    return design


def form_to_json(form: Form) -> dict[str, Any]:
    """Return a form as plain values for `json.dump`."""
    return _to_json(form)


def form_from_json(content: Any) -> Form:
    """Build a form from the result of `json.load`.

    Raises
    ------
    DesignError
        One sentence that names the key.
    """
    form: Form = _read(Form, content, "the form")
    check_form(form)
    checked_name(form.name)
    return form


def _to_json(value: Any) -> dict[str, Any]:
    """Return the fields of a value, without those that are None."""
    values = {f.name: getattr(value, f.name) for f in fields(value)}
    return {key: _plain(content) for key, content in values.items() if content is not None}


def _plain(content: Any) -> Any:
    if is_dataclass(content):
        return _to_json(content)
    return [_plain(part) for part in content] if isinstance(content, tuple) else content


def _correction(content: Any, number: int) -> Correction:
    where = f"corrections[{number}]"
    given = dict(_object(content, where))
    name = given.pop("type", None)
    if not isinstance(name, str) or name not in CORRECTION_TYPES:
        known = ", ".join(f'"{known}"' for known in CORRECTION_TYPES)
        raise DesignError(
            "{where} is of the type {type}, which this version does not know; it knows {known}.",
            where=where,
            type=json.dumps(name),
            known=known,
        )
    correction: Correction = _read(CORRECTION_TYPES[name], given, f"{where} ({name})")
    return correction


def _read(kind: type[Any], content: Any, where: str) -> Any:
    """Read a part, each of its fields by what its class says that it holds."""
    given = _object(content, where)
    _check_keys(given, kind, where)
    held = types_of(kind)
    return kind(**{k: _value(held[k], v, f"{k} of {where}") for k, v in given.items()})


def _value(held: Any, value: Any, where: str) -> Any:
    if is_dataclass(held):
        return _read(held, value, where)  # type: ignore[arg-type]
    if held in _READERS:
        return _READERS[held](value, where)
    return _list(get_args(held)[0], value, where)


def _text(value: Any, where: str) -> str:
    if not isinstance(value, str):
        raise DesignError("{where} must be a text; write it in quotation marks.", where=where)
    return value


def _flag(value: Any, where: str) -> bool:
    if not isinstance(value, bool):
        raise DesignError("{where} must be true or false.", where=where)
    return value


def _places(value: Any, where: str) -> tuple[tuple[float, float], ...]:
    if not isinstance(value, list):
        raise DesignError("{where} must be a list of places, each two numbers in [ ].", where=where)
    return tuple(_place(place, where) for place in value)


def _list(kind: type[Any], value: Any, where: str) -> tuple[Any, ...]:
    if not isinstance(value, list):
        raise DesignError("{where} must be a list of objects; put them in [ ].", where=where)
    places = [Message("{list}[{number}]", list=where, number=n) for n in range(len(value))]
    return tuple(_read(kind, item, place) for item, place in zip(value, places, strict=True))


def _rows(value: Any, where: str) -> tuple[tuple[float, ...], ...]:
    return tuple(_numbers(row, where) for row in _items(value, where))


def _numbers(value: Any, where: str) -> tuple[float, ...]:
    return tuple(_number(number, where) for number in _items(value, where))


def _items(value: Any, where: str) -> list[Any]:
    if not isinstance(value, list):
        raise DesignError("{where} must be a list of numbers; put them in [ ].", where=where)
    return value


def _place(value: Any, where: str) -> tuple[float, float]:
    if not isinstance(value, list) or len(value) != 2:
        raise DesignError("{where} must be two numbers in [ ].", where=where)
    return _number(value[0], where), _number(value[1], where)


def _number(value: Any, where: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise DesignError(
            "{where} must be a number, and is {value}.", where=where, value=json.dumps(value)[:60]
        )
    try:
        return float(value)
    except OverflowError as error:
        raise DesignError(
            "{where} is too large a number; put in a usual one.", where=where
        ) from error


def _side(value: Any) -> Side:
    if value not in ("left", "right"):
        raise DesignError(
            'side must be "left" or "right", and is {value}.', value=json.dumps(value)[:60]
        )
    return Side(value)


def _object(content: Any, where: str) -> dict[str, Any]:
    if not isinstance(content, dict):
        raise DesignError(
            "{where} must be a JSON object, with keys and values in {{ }}.", where=where
        )
    return content


def _check_version(version: Any) -> None:
    if isinstance(version, bool) or not isinstance(version, int) or version < 1:
        raise DesignError(
            "version must be {known}, and is {version}.",
            known=VERSION,
            version=json.dumps(version)[:60],
        )
    if version > VERSION:
        raise DesignError(
            "this design is of version {version}, and this program reads up to version {known}; "
            "install a newer Insole Studio.",
            version=version,
            known=VERSION,
        )


def _check_keys(given: dict[str, Any], kind: type[Any], where: str) -> None:
    described: dict[str, Field[Any]] = {f.name: f for f in fields(kind)}
    required = {
        k for k, f in described.items() if f.default is MISSING and f.default_factory is MISSING
    }
    if kind is InsoleDesign:
        required |= {"corrections"}
    for key in sorted(required - given.keys()):
        raise DesignError('{where} lacks the key "{key}"; add it.', where=where, key=key)
    for key in sorted(given.keys() - described.keys()):
        raise DesignError(
            '{where} has the key "{key}", which this version does not know; check its spelling or '
            "leave it out.",
            where=where,
            key=key,
        )


def _refuse_constant(name: str) -> NoReturn:
    raise DesignError("{name} is no number a design can hold; put in a usual one.", name=name)


_READERS: dict[Any, Callable[[Any, str], Any]] = {
    str: _text,
    bool: _flag,
    float: _number,
    Place: _place,
    tuple[Place, ...]: _places,
    tuple[float, ...]: _numbers,
    tuple[tuple[float, ...], ...]: _rows,
}
"""How a value is read, by what its field holds."""
