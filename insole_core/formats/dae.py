"""COLLADA (.dae), read by trimesh and pycollada behind a door of our own.

Before they see it, the file is walked through once: no entities, no more elements and parts than a
scan has. What they ask for beside it comes from its own folder or archive, and is bounded. What
they return goes through the same checks as any scan.
"""

from __future__ import annotations

import io
from collections import defaultdict
from typing import Any, Final
from urllib.parse import unquote, urlsplit

import collada
import numpy as np
from trimesh.exchange.dae import load_collada

from insole_core.errors import InputError
from insole_core.formats.bounded_xml import walk_xml
from insole_core.formats.raw_surface import RawSurface, placed
from insole_core.formats.scan_content import ScanContent
from insole_core.formats.texture import (
    MOST_TEXTURE_BYTES,
    NO_COLOR,
    is_texture,
    missing_texture,
    sampled,
)
from insole_core.formats.units import MM_PER_UNIT, Unit
from insole_core.geometry.arrays import ByteArray, FloatArray
from insole_core.messages import Message

_MOST_BYTES: Final = 128 * 2**20  # read in 1.5 GB; 1.8 million triangles
_MOST_ELEMENTS, _MOST_PARTS = 100_000, 1000
_HOLD_PARTS: Final = frozenset({"node", "visual_scene"})


def read_dae(source: ScanContent) -> RawSurface:
    """Read all meshes of the scene at the places of their nodes, with their colours or textures.

    Raises
    ------
    InputError
        When it declares entities, or is far larger than a scan.
    ValueError, LookupError, expat.ExpatError
        When it is damaged.
    """
    if len(source.content) > _MOST_BYTES:
        raise InputError(
            "{path} is larger than {limit_mb} MB, which no file of its kind is; choose another "
            "file.",
            path=source.path,
            limit_mb=_MOST_BYTES // 2**20,
        )
    seen = _Seen()
    walk_xml(source.content, source, seen.start, seen.end, seen.text)
    seen.check()
    beside = _Beside(source)
    try:
        scene = load_collada(io.BytesIO(source.content), beside, ignore_broken=False)
    except collada.DaeError as error:
        raise ValueError(Message("its parts do not fit together")) from error
    return _joined(scene, seen.metres_per_unit, tuple(beside.notes))


class _Seen:
    """What the elements of a file tell before anything is made of them."""

    def __init__(self) -> None:
        self.metres_per_unit: float | None = None
        self._count = 0
        self._within: list[str] = []
        self._parts: dict[str, list[str]] = defaultdict(list)
        self._source, self._last = "", ""
        self._without_numbers: set[str] = set()
        self._positions: set[str] = set()

    def start(self, name: str, attributes: dict[str, str]) -> None:
        """Take the start of an element."""
        self._count += 1
        if self._count > _MOST_ELEMENTS:
            raise ValueError(Message("it has far more parts than a scan"))
        self._last = ""
        if name == "source":
            self._source = attributes.get("id", "")
        elif name == "input" and attributes.get("semantic") == "POSITION":
            self._positions.add(attributes["source"].removeprefix("#"))
        elif name == "unit":
            self.metres_per_unit = float(attributes["meter"])
        holder = self._within[-1] if self._within else ""
        if name in _HOLD_PARTS:
            place = attributes.get("id") or f"unnamed {self._count}"
            self._parts[holder].append(place)
            self._within.append(place)
        elif name == "instance_node":
            self._parts[holder].append(attributes["url"].removeprefix("#"))

    def text(self, text: str) -> None:
        """Note numbers that are none: pycollada makes zeros of them."""
        text = self._last + text.lower()
        if "nan" in text:
            self._without_numbers.add(self._source)
        self._last = text[-2:]

    def end(self, name: str) -> None:
        """Take the end of an element."""
        if name in _HOLD_PARTS:
            self._within.pop()

    def check(self) -> None:
        """Refuse what is no length or number, and parts that contain each other."""
        if self._positions & self._without_numbers:
            raise ValueError(Message("coordinates in it are no numbers"))
        metres = self.metres_per_unit
        if metres is not None and not 0 < metres < np.inf:
            raise ValueError(Message("its unit is no length"))
        waiting, count = [""], 0
        while waiting:
            count += 1
            if count > _MOST_PARTS:
                raise ValueError(Message("its nodes contain each other, or are far too many"))
            waiting += self._parts.get(waiting.pop(), ())


class _Beside:
    """Textures for trimesh: from the folder or the archive of the scan, and from nowhere else."""

    def __init__(self, source: ScanContent) -> None:
        self._source = source
        self.notes: dict[Message, None] = {}

    def get(self, name: str) -> bytes:
        """Return the picture of a name; note it where there is none."""
        path = unquote(urlsplit(name).path)
        content = self._source.beside(path, MOST_TEXTURE_BYTES)
        if content is None or not is_texture(content):
            self.notes[missing_texture(path)] = None
            raise LookupError(name)
        return content


def _joined(
    scene: dict[str, Any], metres_per_unit: float | None, notes: tuple[Message, ...]
) -> RawSurface:
    """Join the meshes of a scene, as trimesh describes it."""
    vertices: list[FloatArray] = []
    colors: list[ByteArray | None] = []
    for item in scene["graph"]:
        part = scene["geometry"][item["geometry"]]
        node2scene = np.asarray(item["matrix"], float)
        corners = placed(np.asarray(part["vertices"], float), node2scene)
        painted = _colors(part)
        if np.linalg.det(node2scene[:3, :3]) < 0:  # each triangle has corners of its own
            corners = corners[::-1]
            painted = None if painted is None else painted[::-1]
        vertices.append(corners)
        colors.append(painted)
    if not vertices:
        raise ValueError(Message("it holds no mesh"))
    joined = np.concatenate(vertices)
    unit, factor = _unit(metres_per_unit)
    return RawSurface(
        joined * factor,
        np.arange(len(joined), dtype=np.int32).reshape(-1, 3),
        _all_colors(vertices, colors),
        unit=unit,
        notes=notes,
    )


def _colors(part: dict[str, Any]) -> ByteArray | None:
    """Return the colours (n, 3) of the corners, by themselves or from a texture; None without."""
    if part["vertex_colors"] is not None:
        shades = np.asarray(part["vertex_colors"], float)[:, :3]
        return np.asarray(np.rint(255 * np.clip(np.nan_to_num(shades), 0, 1)), np.uint8)
    visual = part["visual"]
    if visual is None or visual.uv is None or visual.material.baseColorTexture is None:
        return None
    picture = np.asarray(visual.material.baseColorTexture.convert("RGB"))
    return sampled(picture, np.asarray(visual.uv, float))


def _all_colors(vertices: list[FloatArray], colors: list[ByteArray | None]) -> ByteArray | None:
    if all(part is None for part in colors):
        return None
    filled = (
        np.full((len(points), 3), NO_COLOR, np.uint8) if part is None else part
        for points, part in zip(vertices, colors, strict=True)
    )
    return np.concatenate(list(filled))


def _unit(metres: float | None) -> tuple[Unit | None, float]:
    """Return the unit that is stated, and what numbers are multiplied with to be in it."""
    if metres is None:
        return None, 1.0
    for unit, in_mm in MM_PER_UNIT.items():
        if np.isclose(metres * 1000, in_mm, rtol=1e-4):
            return unit, 1.0
    return "m", metres
