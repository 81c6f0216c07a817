"""What the annotations of a class say of its fields, beside their types."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from types import MappingProxyType
from typing import Any, TypeVar, get_type_hints

_Said = TypeVar("_Said")


def said_of_fields(kind: type[Any], what: type[_Said]) -> Mapping[str, _Said]:
    """Return what is said of the fields of a class, by their names, in their order.

    Parameters
    ----------
    what
        Class of what is looked for in annotations such as ``Annotated[float, Number(…)]``; fields
        without one are left out.
    """
    both: tuple[Any, Any] = kind, what
    return _said_of_fields(*both)


@cache  # it takes long, and is asked for each of many values
def _said_of_fields(kind: type[Any], what: type[Any]) -> Mapping[str, Any]:
    said = {
        name: found
        for name, hint in get_type_hints(kind, include_extras=True).items()
        for found in getattr(hint, "__metadata__", ())
        if isinstance(found, what)
    }
    return MappingProxyType(said)
