"""What the tests of the commands share.

Many give the same scan to a command. What the core finds in it, and derives from the foot, is the
same each time; whether it is right, the tests of the core find out. So it is found once, and the
tests here look at what a command does with it.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Hashable, Iterator
from typing import Any

import pytest

from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.memo import Memo
from insole_core.workflows import imprinted_feet, scanned_feet

KEPT = 8
"""Results of each kind, the feet with all that is derived from them included."""


@pytest.fixture(scope="session")
def kept() -> Memo:
    return Memo(KEPT)


@pytest.fixture(scope="module", autouse=True)
def same_scans(kept: Memo) -> Iterator[None]:
    """Let equal scans and equal feet share what is found in them."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Foot, "__init__", _sharing(kept, Foot.__init__))
        for module, name in (
            (scanned_feet, "find_foot"),
            (imprinted_feet, "find_foot"),
            (imprinted_feet, "find_imprints"),
        ):
            patch.setattr(module, name, _found_once(kept, name, getattr(module, name)))
        yield


def _sharing(kept: Memo, begin: Callable[..., None]) -> Callable[..., None]:
    def init(foot: Foot, *args: Any, **kwargs: Any) -> None:
        begin(foot, *args, **kwargs)
        if foot.mesh.touches is None:  # else it is of a session, which every test has its own of
            pose = foot.source2insole.tobytes()
            key = (foot.side, _content(foot.mesh), pose, foot.length_mm, foot.form)
            object.__setattr__(foot, "derived", kept.get("derived", key, lambda: foot.derived))

    return init


def _found_once(kept: Memo, name: str, find: Callable[..., Any]) -> Callable[..., Any]:
    def found(mesh: TriangleMesh, *said: Hashable, **named: Hashable) -> Any:
        def find_in_list() -> list[Any]:
            return [find(mesh, *said, **named)]  # None is an answer as well

        if mesh.touches is not None:
            return find(mesh, *said, **named)
        return kept.get(name, (_content(mesh), said, tuple(named.items())), find_in_list)[0]

    return found


def _content(mesh: TriangleMesh) -> bytes:
    digest = hashlib.blake2b(digest_size=16)
    for array in (mesh.vertices, mesh.triangles, mesh.colors):
        digest.update(b"" if array is None else repr(array.dtype).encode() + array.tobytes())
    return digest.digest()
