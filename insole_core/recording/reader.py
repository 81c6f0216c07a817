"""Strict reading of a session: a violation is one sentence that names the file and the key."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from itertools import combinations
from pathlib import Path

from insole_core.errors import InputError
from insole_core.geometry.arrays import ByteArray, RawArray
from insole_core.json_object import JsonObject
from insole_core.recording.hand_edits import NO_EDITS, HandEdits
from insole_core.recording.hand_edits_file import NAME as EDITS
from insole_core.recording.hand_edits_file import edits_path, parse_edits
from insole_core.recording.images import (
    PngKind,
    check_png,
    decode_color,
    decode_depth,
    decode_grey,
)
from insole_core.recording.manifest_json import parse_manifest
from insole_core.recording.sensor_folder import (
    SENSOR_FILE,
    corrected_image,
    correction_name,
    file_beside,
    infrared_moved_raw,
    infrared_shift_px,
    is_metric,
    parse_sensor,
)
from insole_core.recording.session import (
    DotPictures,
    FrameTimes,
    InfraredPictures,
    Manifest,
    Session,
    View,
)
from insole_core.recording.store import FolderStore, Store, ZipStore
from insole_core.sensing.correction import CorrectedImage, DisparityCorrection, parse_correction
from insole_core.sensing.infrared_reference import (
    InfraredReference,
    check_owner,
    parse_reference,
)
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor

_GREY, _RGB = 0, 2
MOST_FRAMES = 1000
"""Of each kind in a view: half a minute of a Kinect."""
_BITS_AT = 24
"""Where a PNG says how many bits a grey value has."""
_MOST_MS = 1e15
_DOTS = "infrared"
_STEREO_PAIR = ("infrared_left", "infrared_right")


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
    _check_devices(store, views)
    edits = _edits(store, path, manifest)
    if edits.side is not None:
        manifest = replace(manifest, side=edits.side)
    return Session(manifest, _with_shared_cameras(views), str(path), edits)


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
    file = f"{folder}/{SENSOR_FILE}"
    if file not in store.names():
        raise InputError(
            "{file} is missing, but manifest.json names the view {view}; restore it from the "
            "recording.",
            file=store.place(file),
            view=name,
        )
    root = JsonObject.parse(store.place(file), store.read(file))
    if is_metric(root) and not manifest.metric:
        raise root.fail(
            "depth_unit_mm",
            'is of a sensor that delivers millimetres, but "version" in manifest.json is that of '
            "a session of Kinects alone; make the version 3",
        )
    named = correction_name(root)
    correction = None
    if named is not None:
        correction = _correction(store, f"{folder}/{named}", corrected_image(root))
    sensor = parse_sensor(root, correction)
    _check_faces(root, sensor.faces, manifest)
    camera = sensor.depth_camera
    depth = PngKind(camera.width, camera.height, 16, _GREY)
    color = PngKind(sensor.color_camera.width, sensor.color_camera.height, 8, _RGB)
    depth_names = _frames(store, folder, "depth", depth)
    color_names = _frames(store, folder, "color", color)
    decode = decode_depth if sensor.depth_unit_mm is None else decode_grey
    return View(
        name=name,
        sensor=sensor,
        depth_count=len(depth_names),
        color_count=len(color_names),
        read_depth=partial(_read_grey, store, depth_names, decode),
        read_color=partial(_read_color, store, color_names),
        infrared=_stereo_pair(store, folder, sensor),
        times=_times(root, len(depth_names), len(color_names)),
        dots=None if is_metric(root) else _dots(store, folder, root, sensor),
    )


def _dots(store: Store, folder: str, root: JsonObject, sensor: Sensor) -> DotPictures | None:
    """Return the infrared pictures of a Kinect; what is wrong with them spoils no session."""
    named = root.has("infrared_reference")
    if f"{folder}/{_DOTS}_000.png" not in store.names() and not named:
        return None
    dots = DotPictures()
    try:
        kind = PngKind(sensor.depth_camera.width, sensor.depth_camera.height, 16, _GREY)
        names = _frames(store, folder, _DOTS, kind)
        read = partial(_read_grey, store, names, decode_grey)
        dots = replace(dots, pictures=InfraredPictures(len(names), read, 16))
        dots = replace(dots, shift_px=infrared_shift_px(root) or dots.shift_px)
        dots = replace(dots, moved_raw=infrared_moved_raw(root))
    except InputError as error:
        dots = replace(dots, picture_fault=error.message)
    try:
        name, reference = _reference(store, folder, root)
        dots = replace(dots, reference=reference)
        check_owner(name, reference, sensor.serial)
    except InputError as error:
        dots = replace(dots, pattern_fault=error.message)
    return dots


def _reference(store: Store, folder: str, root: JsonObject) -> tuple[str, InfraredReference]:
    """Return the place of the pattern that a view names, and the pattern."""
    if not root.has("infrared_reference"):
        raise InputError(
            "no pattern of dots of the sensor lies beside the infrared pictures; learn it by "
            "calibrate infrared --keep, and put it in by calibrate session."
        )
    place = f"{folder}/{file_beside(root, 'infrared_reference')}"
    if place not in store.names():
        raise InputError(
            "{name} is missing, but sensor.json names it as infrared_reference; restore it from "
            "the recording.",
            name=store.place(place),
        )
    name = store.place(place)
    return name, parse_reference(name, store.read(place))


def _stereo_pair(store: Store, folder: str, sensor: Sensor) -> dict[str, InfraredPictures]:
    """Return the rectified pair behind a stereo camera's depth, where it was recorded."""
    camera = sensor.depth_camera
    kinds = {bits: PngKind(camera.width, camera.height, bits, _GREY) for bits in (8, 16)}
    pair = {}
    for kind in _STEREO_PAIR if sensor.baseline_mm is not None else ():
        if f"{folder}/{kind}_000.png" in store.names():
            names = _frames(store, folder, kind, *kinds.values())
            read = partial(_read_grey, store, names, decode_grey)
            pair[kind] = InfraredPictures(len(names), read, store.read(names[0])[_BITS_AT])
    return pair


def _times(root: JsonObject, depth_count: int, color_count: int) -> FrameTimes | None:
    if not root.has("frame_times_ms"):
        return None
    times = root.object("frame_times_ms")
    return FrameTimes(
        times.numbers("depth", depth_count, -_MOST_MS, _MOST_MS),
        times.numbers("color", color_count, -_MOST_MS, _MOST_MS),
    )


def _check_devices(store: Store, views: list[View]) -> None:
    """Check that sensors of one serial number are one sensor, if they deliver millimetres."""
    for first, second in combinations(views, 2):
        a, b = first.sensor, second.sensor
        if a.serial != b.serial or (a.depth_unit_mm is None and b.depth_unit_mm is None):
            continue
        if (a.model, a.depth_camera, a.color_camera) != (b.model, b.depth_camera, b.color_camera):
            raise InputError(
                "{place}: the views {first} and {second} name one sensor, {serial}, but two "
                "cameras of different kind or calibration; give each view the sensor.json of its "
                "own camera.",
                place=store.place("views"),
                first=first.name,
                second=second.name,
                serial=a.serial,
            )


def _check_faces(root: JsonObject, faces: tuple[str, ...], manifest: Manifest) -> None:
    known = {marker.face for marker in manifest.reference_system.markers}
    unknown = [face for face in faces if face not in known]
    if unknown:
        raise root.fail(
            "faces", 'names "{unknown}", which no marker in manifest.json has', unknown=unknown[0]
        )


def _frames(store: Store, folder: str, kind: str, *expected: PngKind) -> list[str]:
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
        check_png(store.place(name), store.read(name), *expected)
    return names


def _read_grey(
    store: Store, names: list[str], decode: Callable[[str, bytes], RawArray], index: int
) -> RawArray:
    return decode(store.place(names[index]), store.read(names[index]))


def _read_color(store: Store, names: list[str], index: int) -> ByteArray:
    return decode_color(store.place(names[index]), store.read(names[index]))


def _correction(store: Store, name: str, image: CorrectedImage) -> DisparityCorrection:
    if name not in store.names():
        raise InputError(
            "{name} is missing, but sensor.json names it as disparity_correction; restore it from "
            "the recording.",
            name=store.place(name),
        )
    return parse_correction(store.place(name), store.read(name), image)
