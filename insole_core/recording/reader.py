"""Strict reading of a session: a violation is one sentence that names the file and the key."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace
from functools import partial
from pathlib import Path

from insole_core.errors import InputError
from insole_core.geometry.arrays import ByteArray, RawArray
from insole_core.json_object import JsonObject
from insole_core.recording.hand_edits import NO_EDITS, HandEdits
from insole_core.recording.hand_edits_file import NAME as EDITS
from insole_core.recording.hand_edits_file import edits_path, parse_edits
from insole_core.recording.images import PngKind, check_png, decode_color, decode_depth
from insole_core.recording.manifest_json import parse_manifest
from insole_core.recording.sensor_folder import DEPTH_SIZE, correction_name, parse_sensor
from insole_core.recording.session import Manifest, Session, View
from insole_core.recording.store import FolderStore, Store, ZipStore
from insole_core.sensing.correction import DisparityCorrection, parse_correction
from insole_core.sensing.pinhole_camera import PinholeCamera

_GREY, _RGB = 0, 2
MOST_FRAMES = 1000
"""Of each kind in a view: half a minute of a Kinect."""


def read_session(path: Path) -> Session:
    """Open a recorded session, a folder or a zip archive.

    Everything but the pixels is checked here; frames are decoded one at a time when they are read.

    Raises
    ------
    InputError
        When anything in it violates the format (docs/formats/session.md).
    """
    store = _store(path)
    if "manifest.json" not in store.names():
        raise InputError(
            "{path} holds no manifest.json, so it is not a recorded session; choose the folder or "
            "zip archive of a session.",
            path=path,
        )
    manifest = parse_manifest(store.place("manifest.json"), store.read("manifest.json"))
    views = [_view(store, name, manifest) for name in manifest.views]
    return Session(manifest, _with_shared_cameras(views), str(path), _edits(store, path, manifest))


def is_session(path: Path) -> bool:
    """Return whether a path looks like a session rather than a mesh, without opening it."""
    return path.is_dir() or path.suffix.lower() == ".zip"


def _store(path: Path) -> Store:
    if path.is_dir():
        return FolderStore(path)
    if not path.exists():
        raise InputError("{path} does not exist; check the name.", path=path)
    return ZipStore(path)


def _edits(store: Store, path: Path, manifest: Manifest) -> HandEdits:
    """Read the manual corrections; those beside an archive override those inside."""
    place = edits_path(path)
    if path.is_file() and place.is_file():
        beside = FolderStore(place.parent)
        return parse_edits(str(place), beside.read(place.name), manifest)
    if EDITS in store.names():
        return parse_edits(store.place(EDITS), store.read(EDITS), manifest)
    return NO_EDITS


def _with_shared_cameras(views: Iterable[View]) -> tuple[View, ...]:
    """Let views of one device share its depth camera, which caches its pixel rays."""
    known: dict[PinholeCamera, PinholeCamera] = {}
    shared = []
    for view in views:
        camera = known.setdefault(view.sensor.depth_camera, view.sensor.depth_camera)
        shared.append(replace(view, sensor=replace(view.sensor, depth_camera=camera)))
    return tuple(shared)


def _view(store: Store, name: str, manifest: Manifest) -> View:
    folder = f"views/{name}"
    file = f"{folder}/sensor.json"
    if file not in store.names():
        raise InputError(
            "{file} is missing, but manifest.json names the view {view}; restore it from the "
            "recording.",
            file=store.place(file),
            view=name,
        )
    root = JsonObject.parse(store.place(file), store.read(file))
    named = correction_name(root)
    correction = None if named is None else _correction(store, f"{folder}/{named}")
    sensor = parse_sensor(root, correction)
    _check_faces(root, sensor.faces, manifest)
    depth = PngKind(*DEPTH_SIZE, 16, _GREY)
    color = PngKind(sensor.color_camera.width, sensor.color_camera.height, 8, _RGB)
    depth_names = _frames(store, folder, "depth", depth)
    color_names = _frames(store, folder, "color", color)
    return View(
        name=name,
        sensor=sensor,
        depth_count=len(depth_names),
        color_count=len(color_names),
        read_depth=partial(_read_depth, store, depth_names),
        read_color=partial(_read_color, store, color_names),
    )


def _check_faces(root: JsonObject, faces: tuple[str, ...], manifest: Manifest) -> None:
    known = {marker.face for marker in manifest.reference_system.markers}
    unknown = [face for face in faces if face not in known]
    if unknown:
        raise root.fail(
            "faces", 'names "{unknown}", which no marker in manifest.json has', unknown=unknown[0]
        )


def _frames(store: Store, folder: str, kind: str, expected: PngKind) -> list[str]:
    """Return the names of a view's frames in order, each checked to be complete and of its kind."""
    pattern = re.compile(rf"{re.escape(folder)}/{kind}_(\d{{3,}})\.png")
    numbers = sorted(
        int(match[1]) for match in map(pattern.fullmatch, store.names()) if match is not None
    )
    if not numbers:
        raise InputError(
            "{folder} holds no {kind}_000.png, but a view has at least one; restore it from the "
            "recording.",
            folder=store.place(folder),
            kind=kind,
        )
    if len(numbers) > MOST_FRAMES:
        raise InputError(
            "{folder} holds {count} {kind} frames, but a view has at most {most}; take the others "
            "out.",
            folder=store.place(folder),
            count=len(numbers),
            kind=kind,
            most=MOST_FRAMES,
        )
    names = [f"{folder}/{kind}_{number:03d}.png" for number in range(len(numbers))]
    gap = next((names[i] for i, number in enumerate(numbers) if number != i), None)
    if gap is not None:
        raise InputError(
            "{frame} is missing, but later frames are there; restore it or renumber.",
            frame=store.place(gap),
        )
    for name in names:
        check_png(store.place(name), store.read(name), expected)
    return names


def _read_depth(store: Store, names: list[str], index: int) -> RawArray:
    return decode_depth(store.place(names[index]), store.read(names[index]))


def _read_color(store: Store, names: list[str], index: int) -> ByteArray:
    return decode_color(store.place(names[index]), store.read(names[index]))


def _correction(store: Store, name: str) -> DisparityCorrection:
    if name not in store.names():
        raise InputError(
            "{name} is missing, but sensor.json names it as disparity_correction; restore it from "
            "the recording.",
            name=store.place(name),
        )
    return parse_correction(store.place(name), store.read(name))
