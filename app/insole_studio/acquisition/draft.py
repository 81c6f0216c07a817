"""A session during its capture: a folder that keeps every finished view, whatever happens."""

from __future__ import annotations

import errno
import json
import os
import shutil
from collections.abc import Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import platformdirs

from insole_core.errors import InputError, OutputError
from insole_core.files.atomic import (
    copy_into,
    make_output_folder,
    make_private_folder,
    replacing_folder,
    write_private,
    write_text,
)
from insole_core.files.transaction import nothing_foreign
from insole_core.files.write_errors import describe, output_errors
from insole_core.geometry.arrays import ByteArray, RawArray
from insole_core.progress import SILENT, Progress
from insole_core.recording.images import encode_png
from insole_core.recording.manifest_json import manifest_json
from insole_core.recording.reader import read_session
from insole_core.recording.sensor_folder import write_sensor
from insole_core.recording.session import CaptureCondition, FrameTimes, Manifest
from insole_core.recording.writer import foreign_in_session, write_session
from insole_core.sensing.infrared_reference import InfraredReference
from insole_core.sensing.sensor import Sensor
from insole_studio.acquisition.capture_plan import kept_request
from insole_studio.acquisition.capture_setup import Calibrated
from insole_studio.acquisition.messages import UNTUNED, Tuning
from insole_studio.acquisition.sensor_port import InfraredPair
from insole_studio.acquisition.tunings import as_json

_TAKING = ".taking-"
"""Begins the name of the folder of a view that is not finished."""
_FACTS = "capture"
"""The manifest's key for the capture details of each view."""
_WRITERS = 2
_RAW_BYTES_PER_PX, _DEPTH_BYTES_PER_PX, _COLOR_BYTES_PER_PX = 0.4, 1.6, 2.0
"""Upper estimate of the size of a compressed picture: raw numbers have fewer bits than depth."""
_INFRARED_BYTES = 2 * 480 * 640


@dataclass(frozen=True)
class ViewFacts:
    """The capture details of a view that the manifest records.

    Parameters
    ----------
    settled_after_s
        Time from switching the emitters to the first frame used.
    discarded
        Frames that arrived damaged and were left out.
    warm_s
        How long the sensor had been on.
    temperature_c
        How warm it is inside, if it says so.
    times
        When its pictures were taken, if it says so.
    tuning
        What was set of it.
    """

    settled_after_s: float
    discarded: int
    warm_s: float
    warnings: tuple[str, ...] = ()
    temperature_c: float | None = None
    times: FrameTimes | None = None
    tuning: Tuning = UNTUNED


def drafts_folder_of_user() -> Path:
    """Return the folder for unfinished captures."""
    return platformdirs.user_data_path("insole-studio", appauthor=False) / "captures"


class Draft:
    """Writes frames to the disk as they arrive, in the background.

    At any time the folder is a valid session of the finished views. A view that is captured again
    replaces the earlier one once it is complete.

    Parameters
    ----------
    folder
        Created if missing; finished views in it are kept.
    manifest
        The session's manifest without views.
    order
        Order of the views in the manifest.
    """

    def __init__(self, folder: Path, manifest: Manifest, order: Sequence[str]) -> None:
        self.folder = folder
        self._manifest = replace(manifest, views=())
        self._order = list(order)
        self._facts: dict[str, dict[str, Any]] = {}
        self._pool = ThreadPoolExecutor(_WRITERS, thread_name_prefix="capture-writer")
        self._writing: dict[str, list[Future[None]]] = {}
        make_output_folder(folder / "views")

    @classmethod
    def reopen(cls, folder: Path, order: Sequence[str] = ()) -> Draft:
        """Reopen the draft of an earlier capture; without `order`, its views keep their order.

        Parameters
        ----------
        order
            Order of the views, including those still to come.

        Raises
        ------
        InputError
            When the folder is not a draft.
        """
        manifest = read_session(folder).manifest
        facts = manifest.extra.get(_FACTS)
        if not isinstance(facts, dict):
            raise InputError(
                "{folder} was not left by a capture; choose the folder it named.", folder=folder
            )
        kept = kept_request(manifest.extra)
        wanted = order or (kept.plan().views if kept else ())
        draft = cls(folder, manifest, [*wanted, *(view for view in facts if view not in wanted)])
        draft._facts = facts
        draft._remove_unfinished()  # of a capture that was killed
        return draft

    @property
    def manifest(self) -> Manifest:
        """The manifest of the whole capture, without its views."""
        return self._manifest

    @property
    def views(self) -> tuple[str, ...]:
        """Return the finished views in order."""
        return tuple(view for view in self._order if view in self._facts)

    def describe(self, condition: CaptureCondition) -> None:
        """Record how the foot was held, and the notes, as they are known now."""
        self._manifest = replace(self._manifest, capture_condition=condition)
        self._write_manifest()

    def expect(self, order: Sequence[str]) -> None:
        """Put the views of `order` first; the others keep their order behind them."""
        self._order = [*order, *(view for view in self._order if view not in order)]

    def check_room(
        self, frames: int, color_frames: int, sensors: Sequence[Sensor], infrared: int = 0
    ) -> None:
        """Check that the disk has space for a number of frames.

        Parameters
        ----------
        frames, color_frames
            Number of depth and colour pictures of each view.
        sensors
            One for each view.
        infrared
            Number of infrared pictures of all views.

        Raises
        ------
        OutputError
            When it has not.
        """
        needed = sum(
            frames * _depth_bytes(sensor) + color_frames * _color_bytes(sensor)
            for sensor in sensors
        )
        needed += infrared * _INFRARED_BYTES
        if shutil.disk_usage(self.folder).free < needed:
            full = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            raise OutputError(describe(self.folder, full))

    def begin_view(self, view: str, reference: InfraredReference | None = None) -> None:
        """Prepare to take the frames of a view from a sensor.

        Parameters
        ----------
        reference
            Its pattern of dots, which is packed meanwhile; None without one.
        """
        taking = self._taking(view)
        shutil.rmtree(taking, ignore_errors=True)
        make_private_folder(taking)
        self._writing[view] = []
        if reference is not None:
            self._pool.submit(lambda: reference.packed)

    def add_depth(self, view: str, index: int, image: RawArray) -> None:
        """Store depth frame number `index`.

        Parameters
        ----------
        index
            From 0.
        image : (height, width) uint16
            As the sensor delivers it.
        """
        self._store(view, f"depth_{index:03d}.png", image)

    def add_color(self, view: str, index: int, picture: ByteArray) -> None:
        """Store colour frame number `index`.

        Parameters
        ----------
        index
            From 0.
        picture : (height, width, 3) uint8, RGB
        """
        self._store(view, f"color_{index:03d}.png", picture)

    def add_infrared(self, view: str, index: int, picture: RawArray) -> None:
        """Store infrared picture number `index`.

        Parameters
        ----------
        index
            From 0.
        picture : (480, 640) uint16
        """
        self._store(view, f"infrared_{index:03d}.png", picture)

    def add_pair(self, view: str, index: int, pair: InfraredPair) -> None:
        """Store pair number `index`, from 0, of infrared pictures."""
        for eye, picture in zip(("left", "right"), pair, strict=True):
            self._store(view, f"infrared_{eye}_{index:03d}.png", picture)

    def finish_view(self, view: str, calibrated: Calibrated, facts: ViewFacts) -> None:
        """Wait until a view is on the disk, and make it part of the session.

        Parameters
        ----------
        calibrated
            The sensor that recorded it, with its pattern where infrared pictures were added.
        facts
            Written to the manifest.

        Raises
        ------
        OutputError
            When it could not be written; an earlier version of the view remains valid.
        """
        target = self.folder / "views" / view
        with output_errors(target):
            for writing in self._writing.pop(view):
                writing.result()
            write_sensor(calibrated.sensor, self._taking(view), facts.times, calibrated.dots)
            with replacing_folder(target, nothing_foreign) as beside:
                beside.rmdir()
                self._taking(view).rename(beside)
        self._facts[view] = {
            "serial": calibrated.sensor.serial,
            "calibration": calibrated.origin,
            "settled_after_s": round(facts.settled_after_s, 3),
            "discarded_frames": facts.discarded,
            "warm_s": round(facts.warm_s),
            "warnings": list(facts.warnings),
        }
        if facts.temperature_c is not None:
            self._facts[view]["temperature_c"] = round(facts.temperature_c, 1)
        self._facts[view] |= as_json(facts.tuning)
        self._manifest = replace(
            self._manifest,
            metric=self._manifest.metric or calibrated.sensor.depth_unit_mm is not None,
        )
        self._write_manifest()

    def publish(self, path: Path, progress: Progress = SILENT) -> None:
        """Move the session to its destination, as a folder or a zip archive, and remove the draft.

        Parameters
        ----------
        path
            A folder, or a zip archive by its suffix.

        Raises
        ------
        InputError
            When the files on the disk are not what was written.
        OutputError
            When the destination cannot be written; the draft stays.
        """
        if path.resolve().is_relative_to(self.folder.resolve()):
            raise OutputError(
                "{path} lies in the folder of the unfinished capture, which is removed; choose "
                "another place.",
                path=path,
            )
        session = read_session(self.folder)
        if path.suffix.lower() == ".zip":
            write_session(session, path, progress=progress)
        else:
            with replacing_folder(path, foreign_in_session) as beside:
                copy_into(beside, self.folder)
        self.discard()

    def discard(self) -> None:
        """Remove the folder and everything in it."""
        self.close()
        shutil.rmtree(self.folder, ignore_errors=True)

    def close(self) -> None:
        """Stop writing; finished views stay, unfinished ones are removed."""
        self._pool.shutdown(wait=True)
        self._remove_unfinished()
        if not self._facts:
            shutil.rmtree(self.folder, ignore_errors=True)

    def _remove_unfinished(self) -> None:
        for unfinished in self.folder.glob(f"{_TAKING}*"):
            shutil.rmtree(unfinished, ignore_errors=True)

    def _taking(self, view: str) -> Path:
        return self.folder / f"{_TAKING}{view}"

    def _store(self, view: str, name: str, image: RawArray | ByteArray) -> None:
        path = self._taking(view) / name
        writing = self._pool.submit(lambda: _write(path, image))
        self._writing[view].append(writing)

    def _write_manifest(self) -> None:
        extra = {
            **self._manifest.extra,
            "capture": {view: self._facts[view] for view in self.views},
        }
        manifest = replace(self._manifest, views=self.views, extra=extra)
        text = json.dumps(manifest_json(manifest), indent=1, ensure_ascii=False) + "\n"
        write_text(text, self.folder / "manifest.json")


def _depth_bytes(sensor: Sensor) -> float:
    camera = sensor.depth_camera
    rate = _RAW_BYTES_PER_PX if sensor.depth_unit_mm is None else _DEPTH_BYTES_PER_PX
    return rate * camera.width * camera.height


def _color_bytes(sensor: Sensor) -> float:
    return _COLOR_BYTES_PER_PX * sensor.color_camera.width * sensor.color_camera.height


def is_abandoned(folder: Path) -> bool:
    """Return whether a folder is a draft without a finished view, and nothing else is in it."""
    names = {path.name for path in folder.iterdir()}
    others = {name for name in names if not name.startswith(_TAKING)}
    return others == {"views"} and not any((folder / "views").iterdir())


def _write(path: Path, image: RawArray | ByteArray) -> None:
    write_private(path, encode_png(image))
