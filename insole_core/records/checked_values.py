"""Values of a local database, whose tables keep no kind, and no rule that another program removed.

SQLite stores bytes in a column of texts, and nothing where something is needed once a table was
declared anew. A server checks both itself.
"""

from __future__ import annotations

from collections.abc import Callable
from datetime import date
from enum import StrEnum
from typing import Any, TypeVar

from sqlalchemy import Column, ColumnElement, Dialect, func
from sqlalchemy.types import TypeDecorator, TypeEngine

_Word = TypeVar("_Word", bound=StrEnum)


class NoValue(ValueError):  # noqa: N818 - as the other errors of the record
    """A cell holds nothing, or something of another kind."""


class CheckedValue(TypeDecorator[Any]):
    """A column whose values are of its kind when they are read.

    Parameters
    ----------
    kind
        Type of the column.
    needed
        Whether there has to be a value.
    where
        Table and column, for the error.
    """

    impl: TypeEngine[Any] | type[TypeEngine[Any]] = TypeEngine
    cache_ok = True

    def __init__(self, kind: TypeEngine[Any], needed: bool, where: str) -> None:
        self.impl = self.kind = kind
        self.needed = needed
        self.where = where

    def result_processor(self, dialect: Dialect, coltype: object) -> Callable[[Any], Any]:
        """Return what makes a value of what the database holds."""
        made = super().result_processor(dialect, coltype)
        kind, needed, where = self.kind.python_type, self.needed, self.where

        def checked(stored: Any) -> Any:
            try:
                value = stored if made is None else made(stored)
            except (ValueError, TypeError, OverflowError) as error:
                raise NoValue(f"{where}: {error}") from error
            is_kind = stored in (0, 1) if kind is bool else isinstance(value, kind)
            if is_kind or (value is None and not needed):
                return value
            raise NoValue(f"{where} is {'missing' if value is None else 'of another kind'}")

        return checked


def word_of(kind: type[_Word], stored: str) -> _Word:
    """Return one of a few words of the program.

    Raises
    ------
    NoValue
        When it is none of them.
    """
    try:
        return kind(stored)
    except ValueError as error:
        raise NoValue(str(error)) from error


def day_of(moment: str) -> date:
    """Return the day of a moment that the program has written.

    Raises
    ------
    NoValue
        When it is none.
    """
    try:
        return date.fromisoformat(moment[:10])
    except ValueError as error:
        raise NoValue(str(error)) from error


def highest(column: ColumnElement[Any]) -> ColumnElement[Any]:
    """Return the highest value of a column: none where there is no row, needed or not."""
    return func.max(column, type_=type(column.type)())


def lowest(column: ColumnElement[Any]) -> ColumnElement[Any]:
    """Return the lowest value of a column: none where there is no row, needed or not."""
    return func.min(column, type_=type(column.type)())


def check_values(column: Column[Any]) -> None:
    """Let a column of a local database be checked whenever it is read."""
    where = f"{column.table.name}.{column.name}"
    checked = CheckedValue(column.type, not column.nullable, where)
    column.type = column.type.with_variant(checked, "sqlite")
