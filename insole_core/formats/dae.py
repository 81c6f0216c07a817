"""COLLADA (.dae), read by trimesh and pycollada behind a door of our own.

Before they see it, the file is walked through once: no entities, no more elements and parts than a
scan has. What they ask for beside it comes from its own folder or archive, and is bounded. What
they return goes through the same checks as any scan.
"""

from __future__ import annotations

import io
import zipfile
from collections import Counter, defaultdict
from typing import Any, Final
from urllib.parse import unquote, urlsplit

import collada
import cv2
import numpy as np
from trimesh.exchange.dae import load_collada

from insole_core.errors import InputError
from insole_core.formats.bounded_xml import walk_xml
from insole_core.formats.raw_surface import RawSurface, join_placed
from insole_core.formats.scan_content import ScanContent
from insole_core.formats.texture import (
    MOST_TEXTURE_BYTES,
    NO_COLOR,
    colors_of_shares,
    decode_texture,
    missing_texture,
    sampled,
)
from insole_core.formats.units import MM_PER_UNIT, Unit
from insole_core.geometry.arrays import ByteArray
from insole_core.messages import Message

_MOST_BYTES: Final = 128 * 2**20  # read in 1.5 GB; 1.8 million triangles
_MOST_ELEMENTS, _MOST_POLYGONS, _MOST_PARTS = 100_000, 1_000_000, 2000
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
    if zipfile.is_zipfile(io.BytesIO(source.content)):  # pycollada would read what is in it, unseen
        raise ValueError(Message("it hides a zip archive"))
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
        self._counts: Counter[bool] = Counter()
        self._is_after_asset = False
        self._within: list[str] = []
        self._parts: dict[str, list[str]] = defaultdict(list)
        self._element, self._source, self._geometry, self._last = "", "", "", ""
        self._polygon_bytes: Counter[str] = Counter()
        self._without_numbers: set[str] = set()
        self._positions: set[str] = set()

    def start(self, name: str, attributes: dict[str, str]) -> None:
        """Take the start of an element."""
        is_polygon = name == "p"
        self._counts[is_polygon] += 1
        if self._counts[is_polygon] > (_MOST_POLYGONS if is_polygon else _MOST_ELEMENTS):
            raise ValueError(Message("it has far more parts than a scan"))
        self._element, self._last = name, ""
        if name == "source":
            self._source = attributes.get("id", "")
        elif name == "geometry":
            self._geometry = "#" + attributes.get("id", "")  # apart from the names of nodes
        elif name == "input" and attributes.get("semantic") == "POSITION":
            self._positions.add(attributes["source"].removeprefix("#"))
        elif name == "unit" and not self._is_after_asset:
            self.metres_per_unit = float(attributes.get("meter", 1.0))
        holder = self._within[-1] if self._within else ""
        if name in _HOLD_PARTS:
            place = attributes.get("id") or f"unnamed {self._counts[False]}"
            self._parts[holder].append(place)
            self._within.append(place)
        elif name == "instance_node":
            self._parts[holder].append(attributes["url"].removeprefix("#"))
        elif name == "instance_geometry":
            self._parts[holder].append(attributes["url"])

    def text(self, text: str) -> None:
        """Note numbers that are none, of which pycollada makes zeros, and corners below 0."""
        if self._element == "p":
            self._polygon_bytes[self._geometry] += len(text)
            if "-" in text:
                raise ValueError(Message("a triangle in it names a corner that it does not hold"))
        elif self._element == "float_array":
            text = self._last + text.lower()
            if "nan" in text:
                self._without_numbers.add(self._source)
            self._last = text[-2:]

    def end(self, name: str) -> None:
        """Take the end of an element."""
        self._element = ""
        if name in _HOLD_PARTS:
            self._within.pop()
        elif name == "asset":  # the first is of the document
            self._is_after_asset = True

    def check(self) -> None:
        """Refuse what is no length or number, and parts that contain each other."""
        if self._positions & self._without_numbers:
            raise ValueError(Message("coordinates in it are no numbers"))
        metres = self.metres_per_unit
        if metres is not None and not 0 < metres < np.inf:
            raise ValueError(Message("its unit is no length"))
        waiting, count, polygon_bytes = [""], 0, 0
        while waiting:
            part = waiting.pop()
            count += 1
            polygon_bytes += self._polygon_bytes[part]
            if count > _MOST_PARTS or polygon_bytes > _MOST_BYTES:
                raise ValueError(Message("its nodes contain each other, or are far too many"))
            waiting += self._parts.get(part, ())


class _Beside:
    """Textures for trimesh: from the folder or the archive of the scan, and from nowhere else."""

    def __init__(self, source: ScanContent) -> None:
        self._source = source
        self.notes: dict[Message, None] = {}

    def get(self, name: str) -> bytes:
        """Return the picture of a name as a bitmap.

        It is noted as missing until it is read: trimesh passes over whatever fails here.
        """
        missing = missing_texture(unquote(name))
        self.notes[missing] = None
        content = self._source.beside(unquote(urlsplit(name).path), MOST_TEXTURE_BYTES)
        picture = None if content is None else decode_texture(content)
        if picture is None:
            raise LookupError(name)
        del self.notes[missing]
        return cv2.imencode(".bmp", picture[..., ::-1])[1].tobytes()


def _joined(
    scene: dict[str, Any], metres_per_unit: float | None, notes: tuple[Message, ...]
) -> RawSurface:
    """Join the meshes of a scene, as trimesh describes it."""
    parts = [(scene["geometry"][item["geometry"]], item["matrix"]) for item in scene["graph"]]
    if not parts:
        raise ValueError(Message("it holds no mesh"))
    vertices, triangles = join_placed(
        (np.asarray(part["vertices"], float), part["faces"], np.asarray(node2scene, float))
        for part, node2scene in parts
    )
    unit, factor = _unit(metres_per_unit)
    return RawSurface(
        vertices * factor, triangles, _all_colors([part for part, _ in parts]), unit=unit,
        notes=notes,
    )  # fmt: skip


def _colors(part: dict[str, Any]) -> ByteArray | None:
    """Return the colours (n, 3) of the corners, by themselves or from a texture; None without."""
    if part["vertex_colors"] is not None:
        return colors_of_shares(np.asarray(part["vertex_colors"], float)[:, :3])
    visual = part["visual"]
    if visual is None or visual.uv is None or visual.material.baseColorTexture is None:
        return None
    picture = np.asarray(visual.material.baseColorTexture.convert("RGB"))
    return sampled(picture, np.asarray(visual.uv, float))


def _all_colors(parts: list[dict[str, Any]]) -> ByteArray | None:
    colors = [_colors(part) for part in parts]
    if all(part is None for part in colors):
        return None
    filled = (
        np.full((len(part["vertices"]), 3), NO_COLOR, np.uint8) if painted is None else painted
        for part, painted in zip(parts, colors, strict=True)
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
