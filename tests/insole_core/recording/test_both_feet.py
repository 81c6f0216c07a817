"""Sessions of both feet: format version 2, and the reference system they need."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from insole_core.calibration.markers.reference_file import check_reference_system, positions
from insole_core.errors import InputError, ReconstructionError
from insole_core.geometry.side import BOTH, Side
from insole_core.reconstruct.markers.marker_matching import match_markers
from insole_core.recording.box import Box
from insole_core.recording.hand_edits import HandEdits
from insole_core.recording.hand_edits_file import edits_json, parse_edits
from insole_core.recording.manifest_json import manifest_json, parse_manifest
from insole_core.recording.session import Manifest
from insole_core.simulate.scene import load_reference_system

Json = dict[str, Any]
SINGLE, PAIR = load_reference_system("lego-20"), load_reference_system("lego-40")
MANIFEST = Manifest("2026-11-20T10:00:00Z", BOTH, PAIR, ("left", "right"))


def parsed(values: Json) -> Manifest:
    return parse_manifest("manifest.json", json.dumps(values).encode())


def test_a_manifest_of_both_comes_back() -> None:
    values = manifest_json(MANIFEST)
    assert (values["version"], values["side"]) == (2, "both")
    assert parsed(values) == MANIFEST
    assert MANIFEST.sides == (Side.LEFT, Side.RIGHT)


def test_a_manifest_of_one_foot_is_still_of_version_1() -> None:
    values = manifest_json(replace(MANIFEST, side=Side.LEFT, reference_system=SINGLE))
    assert (values["version"], values["side"]) == (1, "left")
    assert parsed(values).sides == (Side.LEFT,)


def test_each_foot_has_its_own_frame_and_volume() -> None:
    left, right = (MANIFEST.of_foot(side) for side in Side)
    assert (left.side, right.side) == (Side.LEFT, Side.RIGHT)
    for manifest, place in zip((left, right), PAIR.feet, strict=True):
        assert manifest.volume_of_interest == place.volume_of_interest
        np.testing.assert_allclose(
            positions(manifest.reference_system.markers) + place.origin_mm,
            positions(PAIR.markers),
        )


BAD: dict[str, tuple[Callable[[Json], object], str]] = {
    "version 4": (lambda m: m.update(version=4), "version 4, which is newer than this program"),
    "version 1": (lambda m: m.update(version=1), 'version is 1, .* one foot, but "side" is "both"'),
    "one side": (
        lambda m: m.update(side="left"),
        'version is 2, .* both feet, but "side" is "left"',
    ),
    "one foot in version 3": (
        lambda m: m.update(version=3, side="left"),
        'side is "left", but the reference system "lego-40" is for both feet; make it "both"',
    ),
    "one foot in version 1": (
        lambda m: m.update(version=1, side="left"),
        'version is 1, .* but the reference system "lego-40" is for both',
    ),
    "markers for one": (
        lambda m: m["reference_frame"].pop("feet"),
        'side is "both", but the reference system "lego-40" is for one foot; name the foot',
    ),
    "no right foot": (
        lambda m: m["reference_frame"]["feet"].pop("right"),
        "reference_frame.feet.right is missing",
    ),
    "exchanged": (
        lambda m: m["reference_frame"]["feet"]["left"].update(origin_mm=[300, 0, 0]),
        "feet.left must lie at smaller x than the right foot",
    ),
    "one volume in the other": (
        lambda m: m["reference_frame"]["feet"]["left"]["volume_of_interest_mm"].update(
            max=[200, 150, 165]
        ),
        "feet.left has a volume that reaches into that of the right foot",
    ),
    "no volume": (
        lambda m: m["reference_frame"]["feet"]["left"].pop("volume_of_interest_mm"),
        "feet.left.volume_of_interest_mm is missing",
    ),
    "a volume for both": (
        lambda m: m.update(volume_of_interest_mm={"min": [0, 0, 0], "max": [1, 1, 1]}),
        "volume_of_interest_mm is for a session of one foot",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_what_contradicts_both_feet_is_refused(name: str) -> None:
    change, expected = BAD[name]
    values = manifest_json(MANIFEST)
    change(values)
    with pytest.raises(InputError, match=expected):
        parsed(values)


def test_corrected_volumes_come_back() -> None:
    edits = HandEdits().with_volume(Side.RIGHT, Box((-60, -150, -20), (60, 150, 100)))
    text = json.dumps(edits_json(edits)).encode()
    assert parse_edits("marker_edits.json", text, MANIFEST) == edits
    assert edits.with_volume(Side.RIGHT, None) == HandEdits()


def test_the_markers_for_both_are_well_placed() -> None:
    assert [check.problems for check in check_reference_system(PAIR)] == [(), ()]


@pytest.mark.parametrize("face", ["sole", "achilles"])
def test_the_markers_of_one_foot_are_never_those_of_the_other_nor_of_the_single_system(
    face: str,
) -> None:
    seen = positions(PAIR.facing((face,)))
    left, right = np.split(seen, 2)
    single = positions(SINGLE.facing((face,)))
    for points, markers in ((seen, single), (single, seen), (left, right), (right, left)):
        with pytest.raises(ReconstructionError):
            match_markers(points, markers)


@pytest.mark.parametrize("side", Side)
def test_the_markers_of_one_foot_alone_tell_where_the_sensor_is(side: Side) -> None:
    seen = positions(PAIR.facing(("sole",)))
    half = np.split(np.arange(len(seen)), 2)[list(Side).index(side)]
    match = match_markers(seen[half], seen)
    np.testing.assert_array_equal(match.markers, half)


def test_the_plan_of_the_frame_for_both_comes_with_it() -> None:
    folder = Path(__file__).parents[3] / "resources" / "reference_systems"
    assert (folder / "lego-40-plan.pdf").read_bytes().startswith(b"%PDF")
