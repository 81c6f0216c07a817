"""Bad input: every reader of the product against thousands of damaged files and command lines.

Each is read in a process of its own, bounded in time and memory. The table counts, for every
family, the inputs and the faults among them: a traceback (or an error that is no sentence with a
remedy), a hang (more than 10 s), memory (more than 2 GB), an input that was accepted although it
must be refused (or the reverse), and an input that reading has changed. All must be 0.

The same seed gives the same inputs. ``FUZZ_ONLY=mesh,case`` runs some families, ``FUZZ_SEED=2``
takes other places for cuts and flipped bits. What was not tried after nine and a half minutes is
counted as a fault too.
"""

from __future__ import annotations

import io
import json
import os
import random
import struct
import tempfile
import zipfile
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks import _fuzz_records
from benchmarks import _fuzz_samples as samples
from benchmarks._fuzz_mutations import (
    PLACES,
    Mutation,
    Zeros,
    byte_mutations,
    entries_of,
    flipped_bit,
    json_mutations,
    zip_mutations,
    zip_of,
)
from benchmarks._fuzz_pool import (
    MOST_SECONDS_WITH_PROGRESS,
    Expected,
    Trial,
    run_command,
)
from benchmarks._fuzz_report import run_families

_MOST_PER_FAMILY = 420

Read = Callable[[Path, Path], None]


def main() -> None:
    run_families(_FAMILIES, _prepare)


def _prepare() -> None:
    samples.foot()
    samples.design()


def _sampled(mutations: Iterable[Mutation], rng: random.Random, most: int) -> list[Mutation]:
    found = list(mutations)
    return found if len(found) <= most else rng.sample(found, most)


def _file_trials(
    family: str, name: str, mutations: Iterable[Mutation], read: Read
) -> Iterator[Trial]:
    """Yield a trial for every content of a file, and for what is no file at all."""
    for what, content, expected in mutations:
        yield Trial(family, f"{name}: {what}", partial(_write, name, content), read, expected)
    for what, place in PLACES.items():
        expected = "refused"
        yield Trial(
            family,
            f"{name}: {what}",
            partial(_place, name, place),
            read,
            expected,
        )


def _write(name: str, content: bytes, folder: Path) -> None:
    (folder / name).write_bytes(content)


def _place(name: str, place: Callable[[Path], object], folder: Path) -> None:
    place(folder / name)


def _read_file_json(read: Callable[[Path], object], given: Path, _written: Path) -> None:
    read(given / "file.json")


# Sessions


def _sessions_as_zip(rng: random.Random) -> Iterator[Trial]:
    mutations = [
        *zip_mutations(samples.SESSION, rng),
        *byte_mutations(samples.SESSION, rng, 60, 30),
    ]
    yield from _file_trials("session zip", "session.zip", mutations, _read_session)
    yield Trial("session zip", "900 frames a view", _many_frames, _read_session, "any")


def _many_frames(folder: Path) -> None:
    entries = dict(entries_of(samples.SESSION))
    frame = entries["views/left/depth_000.png"]
    for view in ("left", "right", "top"):
        entries |= {f"views/{view}/depth_{n:03d}.png": frame for n in range(900)}
    (folder / "session.zip").write_bytes(zip_of(list(entries.items()), zipfile.ZIP_STORED))


def _session_folders(rng: random.Random) -> Iterator[Trial]:
    for file in ("manifest.json", "views/left/sensor.json", "views/top/sensor.json"):
        mutations = _sampled(json_mutations(samples.session_values(file), "refused"), rng, 240)
        contents = [*mutations, *byte_mutations(b"{" + bytes(99), rng, 0, 0)]
        for what, content, expected in contents:
            make = partial(_damaged_session, file, content)
            wanted: Expected = "any" if "notes" in what else expected
            yield Trial("session JSON", f"{file}: {what}", make, _read_session, wanted)
    for file in ("views/left/depth_001.png", "views/right/color_000.png"):
        content = dict(entries_of(samples.SESSION))[file]
        others = dict(entries_of(samples.SESSION))
        wrong = [
            *byte_mutations(content, rng, 25, 15, "refused"),
            (
                "swapped",
                others["views/top/color_000.png" if "depth" in file else "views/top/depth_000.png"],
                "refused",
            ),
            ("huge size", png_of(60_000, 60_000), "refused"),
            ("other size", png_of(320, 240), "refused"),
        ]
        for what, content, expected in wrong:
            make = partial(_damaged_session, file, content)
            yield Trial("session picture", f"{file}: {what}", make, _read_session, expected)
    for file in (
        "manifest.json",
        "views/left/sensor.json",
        "views/left/depth_001.png",
        "views/left/correction.npz",
    ):
        for what, place in PLACES.items():
            make = partial(_session_with, file, place)
            yield Trial("session places", f"{file}: {what}", make, _read_session, "refused")


def _marker_edits(rng: random.Random) -> Iterator[Trial]:
    spots = [{"id": f"S{n}", "pixel": [100.0 * n, 400.0], "exact": n == 1} for n in (1, 2)]
    region = [[0, 0], [10, 0], [10, 10.5]]
    edits = {
        "format": "insole-marker-edits",
        "version": 1,
        "views": {
            "left": {
                "off": False,
                "excluded": ["S3"],
                "named": spots,
                "ignored": [region],
                "searched": region,
            }
        },
        "volume_of_interest_mm": {"min": [-70, -150, -40], "max": [70, 150, 160]},
    }
    mutations = _sampled(json_mutations(edits, "refused", ("searched",)), rng, 200)
    same = [{**spot, "pixel": [5, 5]} for spot in spots]
    edits["views"]["left"]["named"] = same  # type: ignore[index]
    extra: list[Mutation] = [("two markers at one pixel", json.dumps(edits).encode(), "any")]
    for what, content, expected in [*mutations, *extra]:
        make = partial(_damaged_session, "marker_edits.json", content)
        yield Trial("marker edits", what, make, _make_foot, expected, MOST_SECONDS_WITH_PROGRESS)


def _reconstructions(rng: random.Random) -> Iterator[Trial]:
    """Yield sessions whose numbers are odd but allowed: the whole way to a foot must end well."""
    for file in ("manifest.json", "views/left/sensor.json"):
        values = samples.session_values(file)
        odd = [m for m in json_mutations(values) if m[2] == "any"]
        for what, content, expected in _sampled(odd, rng, 45):
            make = partial(_damaged_session, file, content)
            yield Trial(
                "reconstruction",
                f"{file}: {what}",
                make,
                _make_foot,
                expected,
                MOST_SECONDS_WITH_PROGRESS,
            )
    manifest = samples.session_values("manifest.json")
    frame = manifest["reference_frame"]
    for count in (200, 1000, 20_000):
        frame["markers"] = [
            {"id": f"M{n}", "position_mm": [n % 50 * 9.0, n // 50 * 9.0, n % 7], "face": "sole"}
            for n in range(count)
        ] + [{"id": f"A{n}", "position_mm": [n * 9.0, 0, n], "face": "achilles"} for n in range(9)]
        make = partial(_damaged_session, "manifest.json", json.dumps(manifest).encode())
        yield Trial(
            "reconstruction",
            f"{count} markers",
            make,
            _make_foot,
            "any",
            MOST_SECONDS_WITH_PROGRESS,
        )


def _damaged_session(file: str, content: bytes, folder: Path) -> None:
    _unpack_session(folder)
    (folder / "session" / file).write_bytes(content)


def _session_with(file: str, place: Callable[[Path], None], folder: Path) -> None:
    _unpack_session(folder)
    (folder / "session" / file).unlink()
    place(folder / "session" / file)


def _unpack_session(folder: Path) -> None:
    with zipfile.ZipFile(io.BytesIO(samples.SESSION)) as archive:
        archive.extractall(folder / "session")


def _read_session(given: Path, made: Path) -> None:
    from insole_core.recording.reader import read_session

    path = given / "session"
    session = read_session(path if path.exists() else given / "session.zip")
    for view in session.views:
        for index in range(view.depth_count):
            view.read_depth(index)
        for index in range(view.color_count):
            view.read_color(index)


def _make_foot(given: Path, made: Path) -> None:
    from insole_core.workflows.open_scan import open_scan

    open_scan(given / "session")


# Corrections


def _corrections(rng: random.Random) -> Iterator[Trial]:
    sound = dict(entries_of(samples.SESSION))["views/left/correction.npz"]
    with np.load(io.BytesIO(sound)) as stored:
        arrays = {key: stored[key] for key in stored.files}
    arrays |= {
        "slope": arrays["offset"] / 1000,
        "coverage": np.ones((480, 640), np.uint8),
        "reference_raw": np.float64(650),
        "decay": np.float64(0.002),
        "raw_range": np.array([500.0, 900.0]),
    }
    mutations: list[Mutation] = [("as it is", sound, "accepted")]
    for key, bad, expected in _bad_arrays(arrays):
        changed = (
            {**arrays, key: bad}
            if bad is not None
            else {k: v for k, v in arrays.items() if k != key}
        )
        what = f"{key} = {getattr(bad, 'dtype', None)} {getattr(bad, 'shape', None)}"
        mutations.append((what, _npz(changed), expected))
    record = json.loads(str(arrays["record"]))
    for what, content, expected in json_mutations(record, "any"):
        text = np.array(content.decode(errors="replace"))
        mutations.append(
            (
                f"record: {what}",
                _npz({**arrays, "record": text}),
                expected if "figures" not in what else "any",
            )
        )
    mutations += [m for m in zip_mutations(sound, rng) if m[0] not in _SESSION_FOLDERS]
    mutations += byte_mutations(sound, rng, 90, 30)
    mutations += [
        (f"header of {key}: {what}", content, "refused")
        for key in ("offset", "slope")
        for what, content in _lying_headers(arrays, key)
    ]
    yield from _file_trials("correction", "correction.npz", mutations, _read_correction)


_SESSION_FOLDERS = (
    "Mac folder",
    "top folder",
    "top and Mac folder",
    "backslashes",
    "backslashes and a folder",
    "out of it",
    "absolute",
    "drive",
)


def _bad_arrays(arrays: dict[str, Any]) -> Iterator[tuple[str, Any, Expected]]:
    for key, array in arrays.items():
        required: Expected = "refused" if key == "offset" else "any"
        yield key, None, required
        yield key, np.array("text"), "refused"
        yield key, np.array([["a"] * 3] * 2), "refused"
        yield key, np.zeros((0, 0)), "refused"
        yield key, np.zeros((480, 640), complex), "refused"
        yield key, np.zeros((480, 640), "datetime64[s]"), "refused"
        yield key, np.array({"a": 1}, object), "refused"
        yield key, np.zeros(7, [("a", "i4"), ("b", "f8")]), "refused"
        if key != "record":
            like = np.asarray(array, float)
            yield key, np.full(like.shape, np.nan), "refused"
            yield key, np.full(like.shape, np.inf), "refused"
            yield key, np.full(like.shape, 1e300), "refused"
            yield key, np.full((2, *like.shape), 1.0), "refused"


def _lying_headers(arrays: dict[str, Any], key: str) -> Iterator[tuple[str, bytes]]:
    """Yield archives in which one array says that it is of another size."""
    for shape in ("(480, 640000000)", "(99999999999999, 9)", "(-480, -640)", "()", "(480, 640, 0)"):
        packed = io.BytesIO()
        text = f"{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}".ljust(117) + "\n"
        packed.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text.encode())
        packed.write(np.asarray(arrays[key]).tobytes())
        others = [(f"{name}.npy", _npy(array)) for name, array in arrays.items() if name != key]
        yield shape, zip_of([*others, (f"{key}.npy", packed.getvalue())])
    others = [(f"{name}.npy", _npy(array)) for name, array in arrays.items() if name != key]
    yield "bomb", zip_of([*others, (f"{key}.npy", _npy(np.zeros((480, 640 * 400), np.float32)))])


def _npy(array: Any) -> bytes:
    packed = io.BytesIO()
    np.save(packed, array, allow_pickle=True)
    return packed.getvalue()


def _npz(arrays: dict[str, Any]) -> bytes:
    packed = io.BytesIO()
    np.savez_compressed(packed, **arrays)
    return packed.getvalue()


def _read_correction(given: Path, made: Path) -> None:
    from datetime import UTC, datetime

    from insole_core.sensing.correction import load_correction

    correction = load_correction(given / "correction.npz")
    raw = np.full((480, 640), 700.0)
    correction.corrected(raw)
    _ = correction.covered
    correction.record.age_days(datetime.now(UTC))
    correction.save(made / "copy.npz")


# Cases


def _cases(rng: random.Random) -> Iterator[Trial]:
    with tempfile.TemporaryDirectory() as name:
        sound = samples.case_bytes(Path(name))
    entries = dict(entries_of(sound))
    others = [entry for entry in entries.items() if entry[0] != "case.json"]
    mutations: list[Mutation] = []
    texts = json_mutations(json.loads(entries["case.json"]), "refused")
    for what, content, expected in _sampled(texts, rng, _MOST_PER_FAMILY):
        exempt = "notes" in what or what.startswith("feet.0.foot")
        mutations.append(
            (what, zip_of([*others, ("case.json", content)]), "any" if exempt else expected)
        )
    mutations += byte_mutations(sound, rng, 60, 25)
    unused = (*_SESSION_FOLDERS, "100 001 files")
    mutations += [m for m in zip_mutations(sound, rng) if m[0] not in unused]
    mutations += [
        ("version 1", samples.CASES[1], "accepted"),
        ("version 2", samples.CASES[2], "accepted"),
    ]
    foot = entries["left.npz"]
    with np.load(io.BytesIO(foot)) as stored:
        arrays = {key: stored[key] for key in stored.files}
    case = ("case.json", entries["case.json"])
    for key, bad, _ in _bad_arrays(arrays):
        changed = (
            {**arrays, key: bad}
            if bad is not None
            else {k: v for k, v in arrays.items() if k != key}
        )
        expected = "refused" if bad is not None or key in ("vertices", "triangles") else "any"
        mutations.append(
            (
                f"left.npz: {key} = {getattr(bad, 'dtype', None)}",
                zip_of([case, ("left.npz", _npz(changed))]),
                expected,
            )
        )
    for what, content in _lying_headers(arrays, "vertices"):
        mutations.append((f"left.npz: {what}", zip_of([case, ("left.npz", content)]), "refused"))
    for at in (rng.randrange(len(foot)) for _ in range(60)):
        flipped = flipped_bit(foot, at, rng.randrange(8))
        mutations.append((f"left.npz: bit of {at}", zip_of([case, ("left.npz", flipped)]), "any"))
    mutations.append(("6 GB inside", _giant_case(), "refused"))
    yield from _file_trials("case", "case.insole", mutations, _read_case)


def _giant_case() -> bytes:
    names = ("case.json", "left.npz", "right.npz")
    return zip_of([(name, Zeros(2 * 2**30)) for name in names])


def _read_case(given: Path, made: Path) -> None:
    from insole_core.cases.case_file import read_case, write_case
    from insole_core.errors import DesignError
    from insole_core.foot.landmarks import find_landmarks
    from insole_core.insole.build import build_insole

    record = read_case(given / "case.insole")
    write_case(record, made / "copy.insole")
    if (
        record.foot is not None
        and record.design is not None
        and len(record.foot.mesh.vertices) > 99
    ):
        find_landmarks(record.foot)
        try:
            build_insole(record.foot, record.design)
        except DesignError:
            return  # the case opens; the window says what is wrong with its design


# Designs and other JSON


def _designs(rng: random.Random) -> Iterator[Trial]:
    mutations = _sampled(json_mutations(samples.design_values(), "refused"), rng, _MOST_PER_FAMILY)
    mutations += byte_mutations(json.dumps(samples.design_values()).encode(), rng, 40, 20)
    mutations += [(f"{n} pads", _many_pads(n), "any") for n in (50, 300, 10_000)]
    yield from _file_trials("design", "design.json", mutations, _read_design)


def _many_pads(count: int) -> bytes:
    values = samples.design_values()
    pad = next(c for c in values["corrections"] if c["type"] == "pelott")
    values["corrections"] = [{**pad, "id": f"pad {n}"} for n in range(count)]
    return json.dumps(values).encode()


def _read_design(given: Path, made: Path) -> None:
    from insole_core.insole.build import build_insole
    from insole_core.insole.prescription.design_json import read_design

    design = read_design(given / "design.json")
    build_insole(samples.foot(), design)


def _other_json(rng: random.Random) -> Iterator[Trial]:
    from insole_core.calibration.markers.reference_file import (
        check_reference_system,
        load_reference_system,
    )
    from insole_core.compare.best_fit import fit_points, read_picked_points
    from insole_core.evaluation.color_points import load_correspondences, load_object_points
    from insole_core.evaluation.report import load_limits
    from insole_core.foot.landmarks import find_landmarks
    from insole_core.geometry.side import Side
    from insole_core.insole.clinic_rules import load_rules
    from insole_core.insole.forms.form_file import read_form
    from insole_core.insole.prescription.device import read_device
    from insole_core.insole.prescription.materials import read_materials
    from insole_core.insole.prescription.template import apply_template, read_template
    from insole_core.solids.export_rules import read_rules
    from insole_core.solids.shop import read_shop
    from insole_core.workflows.clinic_findings import read_findings

    def reference(path: Path) -> None:
        check_reference_system(load_reference_system(path))

    def template(path: Path) -> None:
        apply_template(read_template(path), Side.RIGHT, _right_landmarks(find_landmarks))

    def points(path: Path) -> None:
        fit_points(*read_picked_points(path))

    object_points = {
        "points": [
            {"name": f"p{n}", "true_mm": [n, 2, 3], "depth_px": [300 + n, 200]} for n in range(4)
        ]
    }
    pairs = {
        "points": [
            {"depth_px": [300 + n, 200], "depth_mm": 800, "color_px": [600, 500]} for n in range(4)
        ]
    }
    picked = {key: [[0, 0, 0], [9, 0, 0], [0, 9, 0], [1, 2, 3]] for key in "ab"}
    readers: list[tuple[str, Any, Callable[[Path], object], int]] = [
        (
            "reference system",
            samples.resource_values("reference_systems/lego-20.json"),
            reference,
            90,
        ),
        ("template", samples.template_values(), template, 150),
        ("picked points", picked, points, 90),
        ("rules", samples.resource_values("rules/rules.json"), load_rules, 90),
        ("export rules", samples.resource_values("rules/export.json"), read_rules, 120),
        ("shop", samples.resource_values("rules/shop.json"), read_shop, 120),
        ("materials", samples.resource_values("rules/materials.json"), read_materials, 120),
        ("device", samples.resource_values("devices/ucbl-child.json"), read_device, 150),
        ("form", samples.resource_values("forms/flat.json"), read_form, 120),
        ("findings", samples.resource_values("findings/findings.json"), read_findings, 150),
        ("limits", samples.resource_values("limits/kinect-v1.json"), load_limits, 60),
        ("object points", object_points, load_object_points, 60),
        ("pairs of points", pairs, load_correspondences, 60),
    ]
    for family, values, read, most in readers:
        mutations = _sampled(json_mutations(values, "any"), rng, most)
        mutations += byte_mutations(json.dumps(values).encode(), rng, 8, 6)
        # What is not one of the product's own keys is ignored, whatever it is.
        mutations = [(what, c, "any" if _ignored(what) else e) for what, c, e in mutations]
        yield from _file_trials(family, "file.json", mutations, partial(_read_file_json, read))
    settings = {"theme": "dark", "linked_views": True, "recent": ["a"], "largest_residual_mm": 2.0}
    for what, content, _ in [
        *json_mutations(settings),
        *byte_mutations(b'{"theme": "dark"}', rng, 9, 9),
    ]:
        yield Trial(
            "settings",
            what,
            partial(_write, "file.json", content),
            _read_settings,
            "accepted",
        )


def _read_settings(given: Path, made: Path) -> None:
    """Read settings; those that are set aside must be there under the new name, unchanged."""
    from insole_studio.settings import load_settings

    path = given / "file.json"
    load_settings(path)
    if not path.exists():
        path.with_name("file.json.broken-1").rename(path)


def _ignored(what: str) -> bool:
    return what.startswith(("comment", "name =", "note"))


def _right_landmarks(find: Callable[[Any], Any]) -> Any:

    from insole_core.foot.foot_placement import place_foot
    from insole_core.geometry.side import Side

    mesh = samples.foot_mesh()
    return find(place_foot(mesh.mirrored(), Side.RIGHT, frame="reference"))


# Recordings of libfreenect, calibration folders


def _recordings(rng: random.Random) -> Iterator[Trial]:
    mutations = _sampled(json_mutations(samples.device_values(), "any"), rng, 200)
    mutations += byte_mutations(json.dumps(samples.device_values()).encode(), rng, 10, 6)
    for what, content, expected in mutations:
        make = partial(write_recording, content, None)
        unused = not what.startswith(("reg_info.zero_plane_info.", "const_shift", "serial"))
        yield Trial(
            "recording",
            f"device.json: {what}",
            make,
            _import,
            "any" if unused or "serial" in what else expected,
        )
    for name in ("INDEX.txt", "d-1.000000-5.pgm", "r-1.000000-5.ppm"):
        for what, content, _expected in byte_mutations(
            b"P5 640 480 65535\n" + bytes(900), rng, 4, 4
        ):
            yield Trial(
                "recording",
                f"{name}: {what}",
                partial(write_recording, None, (name, content)),
                _import,
            )


def write_recording(device: bytes | None, other: tuple[str, bytes] | None, folder: Path) -> None:
    files = {
        "INDEX.txt": b"d-1.000000-5.pgm\nr-1.000000-5.ppm\n",
        "d-1.000000-5.pgm": b"P5 640 480 65535\n" + bytes(640 * 480 * 2),
        "r-1.000000-5.ppm": b"P6 640 480 255\n" + bytes(640 * 480 * 3),
        "device.json": json.dumps(samples.device_values()).encode() if device is None else device,
    }
    files |= dict([other]) if other else {}
    (folder / "recording").mkdir()
    for name, content in files.items():
        (folder / "recording" / name).write_bytes(content)


def _import(given: Path, made: Path) -> None:
    run_command(["import-fakenect", str(given / "recording"), "--out", str(made / "session")])


def _calibration(rng: random.Random) -> Iterator[Trial]:
    depth = dict(entries_of(samples.SESSION))["views/left/depth_000.png"]
    color = dict(entries_of(samples.SESSION))["views/left/color_000.png"]
    board = ["--serial", "A1", "--board", "6x5", "--square", "30"]
    steps = {
        "color": ["calibrate", "color", "in", *board],
        "depth": ["calibrate", "depth", "in", *board],
        "stereo": ["calibrate", "stereo", "in", *board],
        "distortion": ["calibrate", "distortion", "in", "--serial", "A1"],
        "disparity": [
            "calibrate",
            "disparity",
            "in",
            "--serial",
            "A1",
            "--distances",
            "700",
            "900",
        ],
        "shift": ["calibrate", "shift", "in", *board],
        "wall": ["evaluate", "wall", "in"],
        "noise": ["evaluate", "noise", "in"],
    }
    pictures: list[tuple[str, bytes]] = [
        *((what, content) for what, content, _ in byte_mutations(depth, rng, 3, 2)),
        *((what, content) for what, content, _ in byte_mutations(color, rng, 3, 2)),
        ("depth", depth),
        ("colour", color),
        ("6000 x 6000", png_of(6000, 6000)),
        ("60 000 x 60 000", png_of(60_000, 60_000)),
        ("1 x 1", png_of(1, 1)),
        ("20 000 x 1", png_of(20_000, 1)),
    ]
    for step, arguments in steps.items():
        for what, content in pictures:
            make = partial(_pictures, content)
            expected: Expected = "any" if what in ("depth",) or "bit" in what else "refused"
            if step in ("wall", "noise") and what == "colour":
                expected = "any"
            yield Trial(
                "calibration", f"{step}: {what}", make, partial(_command, arguments), expected
            )


def _pictures(content: bytes, folder: Path) -> None:
    for kind in ("color", "ir", "depth"):
        for number in range(2):
            (folder / f"{kind}_{number:03d}.png").write_bytes(content)


def png_of(width: int, height: int) -> bytes:
    """Return a grey PNG of any size; its pixels are all alike, so that it is small."""
    import zlib

    def chunk(kind: bytes, body: bytes) -> bytes:
        return (
            struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        )

    packer = zlib.compressobj(1)
    row = bytes(1 + width)
    rows = min(height, 6000)
    body = b"".join([*(packer.compress(row) for _ in range(rows)), packer.flush()])
    head = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b"")


# Command lines


def _command_lines(rng: random.Random) -> Iterator[Trial]:
    calls: dict[str, list[str]] = {
        "simulate": [
            "simulate",
            "out/s",
            "--seed",
            "1",
            "--distance",
            "800",
            "--bursts",
            "1",
            "--side",
            "left",
        ],
        "reconstruct": ["reconstruct", "in/s.zip", "--out", "out/f.ply", "--method", "fused"],
        "measure": [
            "measure",
            "in/f.ply",
            "--side",
            "left",
            "--report",
            "out/m.json",
            "--csv",
            "out/m.csv",
        ],
        "design": [
            "design",
            "in/f.ply",
            "--side",
            "left",
            "--out",
            "out/i.stl",
            "--draft",
            "3",
            "--chamfer",
            "0",
            "--triangles",
            "5000",
            "--deviation",
            "0.05",
            "--cutter",
            "6",
            "--mark",
            "A",
            "--pseudonym",
            "P",
            "--prescription",
            "in/d.json",
            "--kind",
            "insole",
        ],
        "compare": [
            "compare",
            "in/f.ply",
            "in/f.ply",
            "--report",
            "out/c.json",
            "--align",
            "best",
            "--median",
            "1",
            "--picture",
            "out/c.png",
        ],
        "reference": [
            "calibrate",
            "reference",
            "--length",
            "S1",
            "S2",
            "100",
            "--sessions",
            "in/s.zip",
            "--moved",
            "1",
            "--out",
            "out/r.json",
        ],
        "disparity": [
            "calibrate",
            "disparity",
            "in",
            "--serial",
            "A1",
            "--distances",
            "700",
            "900",
        ],
        "color": [
            "calibrate",
            "color",
            "in",
            "--serial",
            "A1",
            "--board",
            "6x5",
            "--square",
            "30",
            "--marker",
            "20",
            "--dictionary",
            "DICT_5X5_250",
        ],
        "session": ["calibrate", "session", "in/s.zip", "--out", "out/s2"],
        "wall": ["evaluate", "wall", "in", "--limit", "a=1"],
        "capture": [
            "--emulate",
            "in/s.zip",
            "capture",
            "--out",
            "out/c",
            "--frames",
            "1",
            "--color-frames",
            "1",
            "--bursts",
            "1",
            "--side",
            "left",
            "--notes",
            "x",
        ],
        "sensors": ["--emulate", "in/s.zip", "sensors", "--json"],
    }
    bad = [
        "nan",
        "inf",
        "-inf",
        "1e308",
        "-1",
        "0",
        "1e1",
        "7" * 400,
        "",
        " ",
        "x" * 5000,
        "\udc80",
        "--",
        "../in",
        "/dev/zero",
        "/proc/self/mem",
        "in",
        "in/pipe",
        "in/none",
        "in/f.ply",
        "in/s.zip",
        "in/d.json",
    ]
    for name, call in calls.items():
        first = 3 if call[0] == "--emulate" else 1
        for at in range(first, len(call)):
            if call[at].startswith("--"):
                continue
            is_output = call[at].startswith("out/")
            for word in rng.sample([w for w in bad if not (is_output and _is_elsewhere(w))], 5):
                changed = [*call[:at], word, *call[at + 1 :]]
                refuse = (
                    word in ("nan", "inf", "-inf")
                    and call[at - 1].startswith("--")
                    and call[at - 1]
                    not in (
                        "--mark",
                        "--pseudonym",
                        "--notes",
                        "--serial",
                        "--out",
                        "--report",
                        "--report",
                    )
                )
                expected: Expected = "refused" if refuse else "any"
                yield Trial(
                    "command line",
                    f"{name}: {call[at - 1]} {call[at][:20]} -> {word[:20]!r}",
                    _files,
                    partial(_command, changed),
                    expected,
                    MOST_SECONDS_WITH_PROGRESS,
                )
        yield Trial(
            "command line",
            f"{name}: unknown option",
            _files,
            partial(_command, [*call, "--unknown"]),
            "refused",
        )
        yield Trial(
            "command line",
            f"{name}: too little",
            _files,
            partial(_command, call[:first]),
            "refused" if name not in ("sensors", "reference") else "any",
        )


def _is_elsewhere(word: str) -> bool:
    """Return whether a word names what a trial must not replace: inputs, and devices."""
    return word.startswith(("/", "..", "in")) and word not in ("inf", "in/pipe")


def _files(folder: Path) -> None:
    from insole_core.formats.ply import write_ply

    os.mkfifo(folder / "pipe")
    (folder / "s.zip").write_bytes(samples.SESSION)
    (folder / "d.json").write_text(json.dumps(samples.design_values()))
    write_ply(samples.foot_mesh(), folder / "f.ply")


def _command(arguments: list[str], given: Path, made: Path) -> None:
    places = {"in": given, "out": made}
    words = [
        str(places[word.split("/")[0]] / word.partition("/")[2])
        if word.split("/")[0] in places
        else word
        for word in arguments
    ]
    store = (
        ["--sensors", str(made / "sensors")]
        if arguments[0] in ("calibrate", "evaluate") and arguments[1:2] != ["reference"]
        else []
    )
    os.environ["XDG_DATA_HOME"] = str(made / "data")
    os.chdir(made)
    run_command([*words, *store])


# Meshes


def _meshes(rng: random.Random) -> Iterator[Trial]:
    from benchmarks._fuzz_meshes import bad_shapes, damaged_files, sound_files

    for name, content in sound_files():
        yield Trial(
            "mesh", f"{name}: sound", partial(_write, name, content), _read_mesh, "accepted"
        )
        for what, bad, expected in damaged_files(name, content, rng):
            yield Trial("mesh", f"{name}: {what}", partial(_write, name, bad), _read_mesh, expected)
        for what, place in PLACES.items():
            yield Trial(
                "mesh",
                f"{name}: {what}",
                partial(_place, name, place),
                _read_mesh,
                "refused",
            )
    for what, content, expected in bad_shapes():
        yield Trial("shape", what, partial(_write, "foot.stl", content), _read_mesh, expected)


def _read_mesh(given: Path, made: Path) -> None:
    from insole_core.geometry.side import Side
    from insole_core.workflows.open_scan import open_scan

    path = next(given.iterdir(), given / "foot.stl")
    open_scan(path, Side.LEFT)


_FAMILIES: dict[str, Callable[[random.Random], Iterator[Trial]]] = {
    "zip": _sessions_as_zip,
    "session": _session_folders,
    "edits": _marker_edits,
    "reconstruction": _reconstructions,
    "correction": _corrections,
    "case": _cases,
    "design": _designs,
    "json": _other_json,
    "recording": _recordings,
    "calibration": _calibration,
    "mesh": _meshes,
    "command": _command_lines,
    **_fuzz_records.FAMILIES,
}
