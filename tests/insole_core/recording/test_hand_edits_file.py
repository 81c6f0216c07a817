"""Corrections by hand beside a session: what is kept comes back, what is wrong is one sentence."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from insole_core.errors import InputError, OutputError
from insole_core.geometry.side import BOTH, Side
from insole_core.recording.box import Box
from insole_core.recording.hand_edits import NO_EDITS, HandEdits, NamedSpot, ViewEdits
from insole_core.recording.hand_edits_file import edits_json, edits_path, parse_edits, write_edits
from insole_core.recording.manifest_json import parse_manifest
from insole_core.recording.reader import read_session
from insole_core.recording.session import Session
from insole_core.recording.store import FolderStore, ZipStore
from insole_core.recording.writer import write_session

SMALL = Path(__file__).parents[2] / "data" / "sessions" / "left_small.zip"
MANIFEST = read_session(SMALL).manifest
IDS = [marker.id for marker in MANIFEST.reference_system.markers]
EDITS = HandEdits(
    {
        "left": ViewEdits(
            excluded=("S3", "S1"),
            named=(NamedSpot("S5", (812.25, 300.5)), NamedSpot("S6", (10.0, 20.0), exact=True)),
            ignored=(((0.0, 0.0), (40.0, 0.0), (0.0, 40.5)),),
            searched=((0.0, 0.0), (1200.0, 0.0), (1200.0, 900.0), (0.0, 900.0)),
        ),
        "top": ViewEdits(off=True),
    },
    Box((-60.0, -140.0, -40.0), (60.0, 140.0, 150.0)),
)

pixels = st.tuples(*(st.floats(0, 1280),) * 2)
regions = st.lists(pixels, min_size=3, max_size=6).map(tuple)
views = st.builds(
    ViewEdits,
    excluded=st.lists(st.sampled_from(IDS), unique=True).map(tuple),
    named=st.lists(
        st.builds(NamedSpot, st.sampled_from(IDS), pixels, st.booleans()), unique_by=lambda s: s.id
    ).map(tuple),
    ignored=st.lists(regions, max_size=2).map(tuple),
    searched=st.none() | regions,
    off=st.booleans(),
)


@pytest.mark.slow
@given(st.dictionaries(st.sampled_from(MANIFEST.views), views))
def test_every_correction_comes_back(by_view: dict[str, ViewEdits]) -> None:
    edits = HandEdits(by_view)
    assert parse_edits("e.json", json.dumps(edits_json(edits)).encode(), MANIFEST) == edits


@pytest.fixture
def session() -> Session:
    return read_session(SMALL)


@pytest.fixture(params=["folder", "archive.zip"])
def kept(request: pytest.FixtureRequest, session: Session, tmp_path: Path) -> Path:
    path = tmp_path / str(request.param)
    write_session(session, path)
    return path


def test_a_session_is_read_as_the_foot_that_it_was_taken_as(
    kept: Path, session: Session, tmp_path: Path
) -> None:
    assert session.manifest.side is Side.LEFT
    write_edits(HandEdits(side=Side.RIGHT), kept)
    taken = read_session(kept)
    assert taken.manifest.side is taken.edits.side is Side.RIGHT
    assert parse_manifest("manifest.json", manifest_of(kept)).side is Side.LEFT  # as recorded
    write_session(taken, tmp_path / "again.zip")
    assert read_session(tmp_path / "again.zip").manifest.side is Side.RIGHT


def test_of_both_feet_the_place_says_which_is_which() -> None:
    both = replace(MANIFEST, side=BOTH)
    text = json.dumps(edits_json(HandEdits(side=Side.RIGHT))).encode()
    assert parse_edits("e.json", text, both).side is None


def manifest_of(session: Path) -> bytes:
    store = FolderStore(session) if session.is_dir() else ZipStore(session)
    return store.read("manifest.json")


def test_a_session_is_read_with_its_corrections(kept: Path) -> None:
    assert read_session(kept).edits == NO_EDITS
    write_edits(EDITS, kept)
    assert edits_path(kept).is_file()
    assert read_session(kept).edits == EDITS
    write_edits(NO_EDITS, kept)
    assert not edits_path(kept).exists()
    assert read_session(kept).edits == NO_EDITS


def test_a_copy_of_a_session_keeps_its_corrections(session: Session, tmp_path: Path) -> None:
    write_session(replace(session, edits=EDITS), tmp_path / "copy.zip")
    assert read_session(tmp_path / "copy.zip").edits == EDITS
    write_edits(HandEdits().with_view("top", ViewEdits(off=True)), tmp_path / "copy.zip")
    assert read_session(tmp_path / "copy.zip").edits.of("left") == ViewEdits()
    write_edits(NO_EDITS, tmp_path / "copy.zip")
    assert read_session(tmp_path / "copy.zip").edits == NO_EDITS


def test_a_place_that_cannot_be_written(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot be written"):
        write_edits(EDITS, tmp_path / "absent" / "session")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda e: e.update(format="x"), "format is 'x', but must be \"insole-marker-edits\""),
        (lambda e: e.update(version=2), "newer than this program"),
        (lambda e: e.pop("views"), "views is missing"),
        (lambda e: e["views"].update(back={}), "views.back is no view of this session"),
        (lambda e: e["views"]["top"].update(off=1), "views.top.off is 1, but must be true or"),
        (lambda e: e["views"]["left"].update(excluded=["Q"]), "'Q', which no marker"),
        (lambda e: e["views"]["left"]["named"][0].update(id="Q"), 'id is "Q", but must be'),
        (lambda e: e["views"]["left"]["named"][0].update(id="S6"), "names a marker twice"),
        (lambda e: e["views"]["left"]["named"][0].update(pixel=[1]), "has 1 numbers, but must"),
        (lambda e: e["views"]["left"].update(searched=[[1, 2]]), "three corners or more"),
        (lambda e: e["views"]["left"].update(ignored=[[[1, 2]] * 2 + [["x", 1]]]), "number"),
        (lambda e: e["volume_of_interest_mm"].update(min=[99, 0, 0]), "min below max"),
    ],
)
def test_what_is_wrong_is_one_sentence(change: Callable[[dict[str, Any]], Any], said: str) -> None:
    values = json.loads(json.dumps(edits_json(EDITS)))
    change(values)
    with pytest.raises(InputError) as refused:
        parse_edits("marker_edits.json", json.dumps(values).encode(), MANIFEST)
    text = str(refused.value)
    assert said in text
    assert text.startswith("marker_edits.json")
    assert text.endswith(".")
    assert "\n" not in text


def test_no_json_at_all(kept: Path) -> None:
    edits_path(kept).write_text("{")
    with pytest.raises(InputError, match="is not valid JSON"):
        read_session(kept)


def test_naming_a_marker_forgets_what_was_said_before() -> None:
    edits = ViewEdits().with_excluded("S1").with_named(NamedSpot("S1", (1.0, 2.0)))
    assert edits == ViewEdits(named=(NamedSpot("S1", (1.0, 2.0)),))
    assert edits.with_named(NamedSpot("S2", (1.0, 2.0))).named == (NamedSpot("S2", (1.0, 2.0)),)
    assert edits.without_name("S1") == ViewEdits()
    assert not ViewEdits(off=True).corrects_markers
    assert HandEdits().with_view("left", edits).with_view("left", ViewEdits()) == NO_EDITS


def test_the_summary_names_what_was_done() -> None:
    text = EDITS.of("left").summary()
    assert text == "S3, S1 excluded, S5, S6 pointed at, the search limited to a region"
