"""Lets the tests of workflows, commands and the window share what the core finds and makes.

Many open the same scan and build the same insole. What the core makes of it is the same each time;
whether it is right, the tests of what finds and makes it find out. So it is made once for all tests
of a process, and each looks at what a workflow, a command or the window does with it.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from dataclasses import fields, is_dataclass, replace
from enum import Enum
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from insole_core.calibration.boards import board
from insole_core.compare import comparison
from insole_core.foot.foot import Foot
from insole_core.insole import build
from insole_core.insole.build import Insole, build_insole
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.surface import followed_base
from insole_core.insole.surface.contact import ContactBase, base_key, contact_base
from insole_core.memo import Memo
from insole_core.progress import SILENT, Progress
from insole_core.reconstruct import reconstruction
from insole_core.reconstruct.fusion.prepared_view import PreparedView
from insole_core.reconstruct.views.measured_view import MeasuredView
from insole_core.recording.session import View
from insole_core.solids import order, solid
from insole_core.solids.solid import ClosedInsole
from insole_core.workflows import (
    compare_case,
    imprinted_feet,
    insole_builder,
    make_foot,
    make_order,
    scanned_feet,
)

KEPT, KEPT_FEET, KEPT_VIEWS, KEPT_SMALL = 4, 3, 6, 256
"""Results of each kind; feet, with what is derived from each of them, which is some 50 MB; views of
sessions, some 8 MB each; and corners of boards, of which a sensor's pictures show many."""
OF_FEET = frozenset({"derived", "place_foot", "find_foot", "find_imprints", "recognised_foot"})
OF_VIEWS = frozenset({"measure_view"})
SMALL = frozenset({"_chequerboard_corners"})

SHARED = (
    (scanned_feet, "find_foot"),
    (imprinted_feet, "find_foot"),
    (imprinted_feet, "find_imprints"),
    (reconstruction, "prepare"),
    (reconstruction, "fuse"),
    (MeasuredView, "_registered"),
    (comparison, "recognised_foot"),
    (compare_case, "compare_surfaces"),
    (order, "simplify"),
    (order, "check_solid"),
    (board, "_chequerboard_corners"),
)
"""Functions whose results are told by the content of what they are given."""


class SharedResults:
    """The results that tests share, until one asks that all be made anew."""

    def __init__(self) -> None:
        self.forget()

    def forget(self) -> None:
        """Let everything be found and made anew."""
        self._memo, self._feet = Memo(KEPT), Memo(KEPT_FEET)
        self._views, self._small = Memo(KEPT_VIEWS), Memo(KEPT_SMALL)

    def get(self, kind: str, key: Hashable, make: Callable[[], Any]) -> Any:
        memos = ((OF_FEET, self._feet), (OF_VIEWS, self._views), (SMALL, self._small))
        memo = next((memo for kinds, memo in memos if kind in kinds), self._memo)
        return memo.get(kind, key, make)


def share_results(
    kept: SharedResults,
    patch: pytest.MonkeyPatch,
    more: Iterable[tuple[Any, str]] = (),
    builders: Iterable[Any] = (),
) -> None:
    """Let equal scans and equal feet share what is found in them and made of them.

    Parameters
    ----------
    more
        Functions beside those of the core, as in `SHARED`.
    builders
        Other modules that call `build_insole`.
    """
    patch.setattr(Foot, "__init__", _sharing(kept, Foot.__init__))
    for owner, name in (*SHARED, *more):
        patch.setattr(owner, name, _made_once(kept, name, getattr(owner, name)))
    patch.setattr(make_foot, "measure_view", _measured_once(kept, make_foot.measure_view))
    patch.setattr(make_foot, "place_foot", _placed_once(kept, make_foot.place_foot))
    base = _based_once(contact_base)
    for module in (insole_builder, followed_base):
        patch.setattr(module, "contact_base", base)
    for module in (build, make_order, *builders):
        patch.setattr(module, "build_insole", partial(build_insole, base_of=base))
    closed = _closed_once(solid.closed_insole)
    for module in (insole_builder, solid):
        patch.setattr(module, "closed_insole", closed)


def share_bases(patch: pytest.MonkeyPatch) -> None:
    """Let insoles of one foot that differ in their pads only share the surface before these."""
    defaults = {**(build_insole.__kwdefaults__ or {}), "base_of": _based_once(contact_base)}
    patch.setattr(build_insole, "__kwdefaults__", defaults)


def _sharing(kept: SharedResults, begin: Callable[..., None]) -> Callable[..., None]:
    def init(foot: Foot, *args: Any, **kwargs: Any) -> None:
        begin(foot, *args, **kwargs)
        key = _content(foot.side, foot.mesh, foot.source2insole, foot.length_mm, foot.form)
        object.__setattr__(foot, "derived", kept.get("derived", key, lambda: foot.derived))

    return init


def _made_once(kept: SharedResults, name: str, make: Callable[..., Any]) -> Callable[..., Any]:
    def made(*given: Any, **named: Any) -> Any:
        def make_in_list() -> list[Any]:
            return [make(*given, **named)]  # None is an answer as well

        return kept.get(name, _content(given, named), make_in_list)[0]

    return made


def _measured_once(
    kept: SharedResults, measure: Callable[[View], MeasuredView]
) -> Callable[[View], MeasuredView]:
    """Measure equal frames once; each view keeps the files that it was read from."""

    def measured(view: View) -> MeasuredView:
        if not isinstance(view.read_depth, partial):  # frames that a test has made up
            return measure(view)
        key = _content(view.name, view.sensor, view.times, *_frame_files(view))
        once = kept.get("measure_view", key, lambda: measure(view))
        found = replace(once, view=replace(view, sensor=once.view.sensor))
        vars(found).update(blobs=once.blobs, sightings=once.sightings, derived=once.derived)
        return found

    return measured


def _frame_files(view: View) -> Iterator[bytes]:
    """Iterate over the files of depth and colour frames, as they were recorded."""
    for read in (view.read_depth, view.read_color):
        store, names, *_ = read.args
        yield from map(store.read, names)


def _placed_once(kept: SharedResults, place: Callable[..., Foot]) -> Callable[..., Foot]:
    once = _made_once(kept, "place_foot", place)

    def placed(*given: Any, **named: Any) -> Foot:
        return replace(once(*given, **named))  # a foot made again is another one

    return placed


def _based_once(base: Callable[..., ContactBase]) -> Callable[..., ContactBase]:
    def based(foot: Foot, design: InsoleDesign, progress: Progress = SILENT) -> ContactBase:
        key = base_key(design)
        return foot.derived.get("contact base", key, lambda: base(foot, design, progress))

    return based


def _closed_once(close: Callable[..., ClosedInsole]) -> Callable[..., ClosedInsole]:
    def closed(insole: Insole, *options: Any) -> ClosedInsole:
        key = _content(insole.design, insole.contact, options)
        return insole.foot.derived.get("closed insole", key, lambda: close(insole, *options))

    return closed


def _content(*values: Any) -> bytes:
    """Return a digest that is equal for equal values, however they were made."""
    digest = hashlib.sha256()  # processors have it built in: half the time of blake2b
    _add(digest, values)
    return digest.digest()


def _add(digest: Any, value: Any) -> None:
    digest.update(type(value).__name__.encode() + b"(")
    if isinstance(value, np.ndarray):
        digest.update(f"{value.dtype}{value.shape}".encode())
        digest.update(np.ascontiguousarray(value))
    elif isinstance(value, str | bytes | int | float | Enum | Path | None):
        digest.update(repr(value).encode())
    elif not isinstance(value, Progress):
        for part in _parts(value):
            _add(digest, part)
    digest.update(b")")


def _parts(value: Any) -> Iterable[Any]:
    if isinstance(value, PreparedView):  # all else follows from it
        found = (part is None for part in (value.within, value.outline, value.rim))
        return value.measured, value.infrared, *found
    if isinstance(value, MeasuredView):  # its files may have any place
        return value.view.name, value.view.sensor, value.raw, value.color, value.precise
    if is_dataclass(value):
        return [getattr(value, field.name) for field in fields(value) if field.init]
    if isinstance(value, Mapping):
        return value.items()
    if isinstance(value, list | tuple):
        return value
    raise TypeError(f"what is equal to {value!r}?")
