"""Write what designs declare into their schema: `python docs/design_schema.py`.

Types, ranges, words and defaults of docs/formats/design.schema.json come from the classes of a
design; what is said there beyond that, such as which keys go together, is kept as it is written.
"""

from __future__ import annotations

import json
from dataclasses import MISSING, Field, fields
from pathlib import Path
from typing import Any

from insole_core.insole.elements import CORRECTION_TYPES
from insole_core.insole.fields import Choice, Declared, Line, Place, Range, declared, types_of
from insole_core.insole.prescription.base_form import BaseForm, Form
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline, Shoe
from insole_core.insole.prescription.shell import Post, Shell

SCHEMA = Path(__file__).parent / "formats" / "design.schema.json"
PARTS: dict[str, type[Any]] = {
    **CORRECTION_TYPES, "outline": Outline, "shoe": Shoe, "layers": Layers, "base": BaseForm,
    "form": Form, "finish": Finish, "rim_station": RimStation, "shell": Shell, "post": Post,
}  # fmt: skip
_PLAIN = {str: "string", bool: "boolean", float: "number"}


def with_declared(schema: dict[str, Any]) -> dict[str, Any]:
    """Return a schema with what the classes of a design declare."""
    parts = schema["$defs"]
    defined = {name: _part(parts.get(name), kind, name) for name, kind in PARTS.items()}
    properties = _properties(InsoleDesign, schema["properties"])
    properties["corrections"]["items"]["oneOf"] = [
        {"$ref": f"#/$defs/{name}"} for name in CORRECTION_TYPES
    ]
    return {**schema, "properties": properties, "$defs": {**parts, **defined}}


def written(value: Any, indent: int = 0) -> str:
    """Write a value as JSON, in one line if it holds no other object or list."""
    held = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    if not any(isinstance(one, dict | list) for one in held):
        return json.dumps(value, ensure_ascii=False)
    items = (
        [f"{json.dumps(key)}: {written(one, indent + 2)}" for key, one in value.items()]
        if isinstance(value, dict)
        else [written(one, indent + 2) for one in value]
    )
    opening, closing = "{}" if isinstance(value, dict) else "[]"
    inner = ",\n".join(f"{' ' * (indent + 2)}{item}" for item in items)
    return f"{opening}\n{inner}\n{' ' * indent}{closing}"


def _part(known: dict[str, Any] | None, kind: type[Any], name: str) -> dict[str, Any]:
    if known is not None:
        return {**known, "properties": _properties(kind, known["properties"])}
    return {
        "type": "object",
        "required": ["type", *(f.name for f in fields(kind) if _is_required(f))],
        "additionalProperties": False,
        "properties": {"type": {"const": name}, **_properties(kind, {})},
    }


def _properties(kind: type[Any], known: dict[str, Any]) -> dict[str, Any]:
    """Return the properties of a part; those that are parts themselves stay as they are."""
    found, held = declared(kind), types_of(kind)
    told = {
        f.name: _property(f, held[f.name], found.get(f.name))
        for f in fields(kind)
        if f.name in found or held[f.name] in _PLAIN
    }
    return {**known, **{name: _merged(own, known.get(name, {})) for name, own in told.items()}}


def _property(field: Field[Any], held: Any, found: Declared | None) -> dict[str, Any]:
    default = {} if field.default in (MISSING, None) else {"default": _number(field.default)}
    if isinstance(found, Choice) and held is str:
        return {"enum": list(found.words), **default}
    return {**_shape(held, found), **default}


def _shape(held: Any, found: Declared | None) -> dict[str, Any]:
    if held in _PLAIN:
        return {"type": _PLAIN[held], **_limits(found)}
    if held == Place:
        return {"type": "array", "minItems": 2, "maxItems": 2, "items": _shape(float, found)}
    counts = {"minItems": found.fewest, "maxItems": found.most} if isinstance(found, Line) else {}
    return {"type": "array", **counts, "items": _shape(held.__args__[0], found)}


def _limits(found: Declared | None) -> dict[str, Any]:
    allowed: Range | None = None if found is None else found.range
    if allowed is None:
        return {}
    return {"minimum": _number(allowed.least), "maximum": _number(allowed.greatest)}


def _number(value: Any) -> Any:
    return int(value) if isinstance(value, float) and value.is_integer() else value


def _merged(own: dict[str, Any], known: dict[str, Any]) -> dict[str, Any]:
    """Return what is declared, with what is said beyond it."""
    inner = {
        key: _merged(value, known[key])
        for key, value in own.items()
        if isinstance(value, dict) and isinstance(known.get(key), dict)
    }
    return {**known, **own, **inner}


def _is_required(field: Field[Any]) -> bool:
    return field.default is MISSING and field.default_factory is MISSING


def main() -> None:
    """Write the schema anew."""
    schema = with_declared(json.loads(SCHEMA.read_text("utf-8")))
    SCHEMA.write_text(written(schema) + "\n", "utf-8")


if __name__ == "__main__":
    main()
