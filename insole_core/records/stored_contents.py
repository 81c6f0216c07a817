"""Rows that say what the content store holds and the database refers to."""

from __future__ import annotations

from pathlib import Path

from sqlalchemy import Connection

from insole_core.records.content_store import ContentStore
from insole_core.records.database import upsert
from insole_core.records.schema import contents
from insole_core.records.times import utc_now


def refer_to(connection: Connection, sha256: str, size: int, kind: str) -> None:
    """Write the row of a content that is stored by now, unless there is one.

    Parameters
    ----------
    size
        Bytes.
    kind
        ``mesh``, ``session``, ``file``, …: what to expect in it.
    """
    values = {"sha256": sha256, "size": size, "kind": kind, "created_at": utc_now()}
    upsert(connection, contents, values)


def put_file(store: ContentStore, path: Path) -> tuple[str, int]:
    """Store a file; return its SHA-256 and its size in bytes.

    Raises
    ------
    InputError, OutputError, Unreachable
        As for `ContentStore.put`.
    """
    sha256 = store.put(path)
    return sha256, store.path(sha256).stat().st_size
