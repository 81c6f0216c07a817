"""Maps and footprints are laid where they were pressed, and those of the other foot are told."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from PIL import Image

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord, FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import InputError
from insole_core.foot.alignment import quarter_turned
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.pressure.alignment import SolePrint
from insole_core.pressure.laid_map import Placement, PressureMap
from insole_core.pressure.picture import read_picture_file, with_distance, with_dpi
from insole_core.pressure.recording import Answers, PressureRecording, PressureUnit, SeenFrom
from insole_core.pressure.regions import REGIONS, overloaded_heads, region_peaks
from insole_core.simulate.plantar_pressure import pressed
from insole_core.workflows.findings import Catalogue
from insole_core.workflows.foot_landmarks import lying_anew
from insole_core.workflows.lay_plantar import Shown, lay_picture, lay_pressure
from insole_core.workflows.pad_library import load_pads
from insole_core.workflows.plantar_pressure import (
    heads_to_relieve,
    with_picture,
    with_pressure,
    with_reliefs,
)

_SOURCE = ScanSource("mesh", "/scans/foot.ply", "0" * 64)


def _answers(foot: Foot, seen_from: SeenFrom = SeenFrom.ABOVE) -> Answers:
    return Answers(foot.side, (5.0, 5.0), unit=PressureUnit.KPA, seen_from=seen_from)


def _recording(kpa: np.ndarray) -> PressureRecording:
    return PressureRecording("", "", kpa[None].astype(np.float32))


def _apart_mm(found: PressureMap, true: Placement) -> float:
    points = found.centres_mm[found.kpa > 0]
    apart = found.placement.to_insole(points) - true.to_insole(points)
    return float(np.sqrt((apart**2).sum(axis=1).mean()))


def _laid(foot: Foot, kpa: np.ndarray, answers: Answers) -> PressureMap:
    laid = lay_pressure(foot, _recording(kpa), answers, Shown(), "map.csv")
    assert laid.doubts == ()
    return laid.pressure


@pytest.mark.parametrize("missing", ["", "toes", "midfoot", "rear"])
def test_a_map_is_found_within_3_mm(left_foot: Foot, right_foot: Foot, missing: str) -> None:
    rng = np.random.default_rng(7)
    apart = []
    for foot, mirrored in ((left_foot, False), (right_foot, True)):
        place = Placement(
            rng.uniform(-40, 40), rng.uniform(80, 160), rng.uniform(-180, 180), mirrored
        )
        seen_from = SeenFrom.BELOW if mirrored else SeenFrom.ABOVE
        kpa = pressed(foot, place, rng, missing).kpa
        apart.append(_apart_mm(_laid(foot, kpa, _answers(foot, seen_from)), place))
    assert np.sqrt(np.mean(np.square(apart))) < 3.0


def test_the_map_of_the_other_foot_is_told(left_foot: Foot, right_foot: Foot) -> None:
    rng = np.random.default_rng(3)
    kpa = pressed(right_foot, Placement(0, 120, 20), rng).kpa
    laid = lay_pressure(left_foot, _recording(kpa), _answers(left_foot), Shown(), "map.csv")
    assert "looks like the map of a right foot" in laid.doubts[0]
    with pytest.raises(InputError, match="map of a right foot, and the foot is a left"):
        lay_pressure(left_foot, _recording(kpa), _answers(right_foot), Shown(), "map.csv")


def test_a_heel_alone_is_not_laid_by_itself(left_foot: Foot) -> None:
    kpa = pressed(left_foot, Placement(0, 120, 0), np.random.default_rng(3)).kpa
    kpa[:48] = 0  # from 60 mm ahead of the heel on
    laid = lay_pressure(left_foot, _recording(kpa), _answers(left_foot), Shown(), "map.csv")
    assert "lay it by hand" in laid.doubts[0]


def test_a_map_in_another_unit_is_told(left_foot: Foot) -> None:
    kpa = pressed(left_foot, Placement(0, 120, 0), np.random.default_rng(3)).kpa
    laid = lay_pressure(left_foot, _recording(kpa / 10), _answers(left_foot), Shown(), "map.csv")
    assert "check the unit" in laid.doubts[-1]


def test_what_is_not_known_has_to_be_stated(left_foot: Foot) -> None:
    recording = _recording(np.full((30, 20), 50.0))
    with pytest.raises(InputError, match="distance of the sensors"):
        lay_pressure(left_foot, recording, Answers(), Shown(), "map.csv")


def _print_picture(foot: Foot, path: Path, dpi: float, *, mirrored: bool, stated: bool) -> Path:
    """Write an ink print of a foot, lying askew on its page."""
    place = Placement(3.0, 118.0, 8.0, mirrored)
    pixel_mm = 25.4 / dpi
    size = round(310 / pixel_mm), round(160 / pixel_mm)
    row, column = np.mgrid[: size[0], : size[1]]
    x = (column - (size[1] - 1) / 2) * pixel_mm
    y = ((size[0] - 1) / 2 - row) * pixel_mm
    points = place.to_insole(np.stack([x.ravel(), y.ravel()], axis=1))
    heights = cv2.remap(
        SolePrint.of(foot).heights_mm.astype(np.float32),
        SolePrint.of(foot).cells(points)[1].astype(np.float32).reshape(size),
        SolePrint.of(foot).cells(points)[0].astype(np.float32).reshape(size),
        cv2.INTER_LINEAR, borderValue=30,
    )  # fmt: skip
    grey = np.where(heights < 6, 60, 235).astype(np.uint8)
    image = Image.fromarray(np.stack([grey] * 3, axis=-1))
    image.save(path, **({"dpi": (dpi, dpi)} if stated else {}))
    return path


def test_a_print_is_laid_in_its_scale(right_foot: Foot, tmp_path: Path) -> None:
    picture, same = (
        with_dpi(
            read_picture_file(
                _print_picture(right_foot, tmp_path / name, 100, mirrored=True, stated=True)
            )
        )
        for name in ("ink.png", "ink.tif")
    )
    np.testing.assert_array_equal(picture.colors, same.colors)
    assert picture.pitch_mm == pytest.approx(same.pitch_mm, rel=1e-4)
    laid = lay_picture(right_foot, picture, SeenFrom.BELOW)
    assert laid.doubts == ()
    corners = np.array([[0.0, 110.0], [0.0, -110.0]])
    true = Placement(3.0, 118.0, 8.0, True).to_insole(corners)
    found = laid.picture.placement.to_insole(corners)
    assert np.linalg.norm(found - true, axis=1).max() < 4.0
    wrong = lay_picture(right_foot, picture, SeenFrom.ABOVE)
    assert "left foot" in wrong.doubts[0]


def test_the_scale_of_a_picture_is_asked_where_it_states_none(
    left_foot: Foot, tmp_path: Path
) -> None:
    path = _print_picture(left_foot, tmp_path / "ink.png", 100, mirrored=False, stated=False)
    picture = read_picture_file(path)
    assert picture.dpi is None
    with pytest.raises(InputError, match="dots per inch"):
        with_dpi(picture)
    with pytest.raises(InputError, match="mm long"):
        with_dpi(picture, 600)
    by_hand = with_distance(picture, (0, 0), (0, 1000), 254.0)
    assert by_hand.pitch_mm * by_hand.colors.shape[0] == pytest.approx(310, abs=1)


def test_what_is_no_picture_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    for content in (b"", b"\x89PNG\r\n\x1a\n" + b"\0" * 40, b"GIF89a" + b"\0" * 40):
        path.write_bytes(content)
        with pytest.raises(InputError, match="no readable PNG"):
            read_picture_file(path)


def test_peaks_and_reliefs_follow_the_heads(left_foot: Foot) -> None:
    marks = find_landmarks(left_foot)
    third = marks["metatarsal_head_3"].point[:2]
    laid = PressureMap(np.full((60, 24), 80.0), (5.0, 5.0), Placement(0.0, 125.0))
    lying = laid.placement.to_insole(laid.centres_mm.reshape(-1, 2))
    nearest = int(np.linalg.norm(lying - third, axis=1).argmin())
    laid.kpa.ravel()[nearest] = 320.0
    peaks = region_peaks(laid, marks)
    assert set(peaks) == set(REGIONS)
    assert peaks["head_3"] == 320
    assert [peaks[name] for name in REGIONS if name != "head_3"] == [80.0] * 8
    assert overloaded_heads(peaks) == (3,)
    design = InsoleDesign(side=left_foot.side)
    catalogue = Catalogue({}, "", load_pads(), 8.0)
    relieved = with_reliefs(design, heads_to_relieve(design, (3,)), marks, catalogue)
    (pad,) = relieved.corrections
    assert isinstance(pad, Pelott)
    assert pad.kind == "relief_head_3"
    assert np.linalg.norm(np.array(pad.centre_mm) - third) < 5
    assert heads_to_relieve(relieved, (3, 4)) == (4,)


def test_what_is_loaded_beside_the_foot_counts_to_no_region(left_foot: Foot) -> None:
    kpa = np.full((80, 50), 80.0)
    kpa[[0, -1]] = kpa[:, [0, -1]] = 900.0
    laid = PressureMap(kpa, (5.0, 5.0), Placement(0.0, 125.0))
    assert region_peaks(laid, find_landmarks(left_foot)) == dict.fromkeys(REGIONS, 80.0)


def test_a_case_keeps_map_and_picture(left_foot: Foot, right_foot: Foot, tmp_path: Path) -> None:
    kpa = pressed(left_foot, Placement(0, 120, 20), np.random.default_rng(3)).kpa
    kpa[0, 0] = np.nan
    left = with_pressure(
        FootRecord.begun(left_foot, _SOURCE), _laid(left_foot, kpa, _answers(left_foot))
    )
    path = _print_picture(right_foot, tmp_path / "ink.png", 60, mirrored=True, stated=True)
    picture = lay_picture(right_foot, with_dpi(read_picture_file(path)), SeenFrom.BELOW).picture
    right = with_picture(FootRecord.begun(right_foot, _SOURCE), picture)
    record = CaseRecord.of_foot(left).with_foot(right)
    file = tmp_path / "case.insole"
    write_case(record, file)
    read = read_case(file)
    first, second = read.feet
    assert first.plantar.pressure is not None
    assert left.plantar.pressure is not None
    assert np.array_equal(first.plantar.pressure.kpa, left.plantar.pressure.kpa, equal_nan=True)
    assert first.plantar.pressure.placement == left.plantar.pressure.placement
    assert second.plantar.picture is not None
    assert np.array_equal(second.plantar.picture.colors, picture.colors)
    assert second.plantar.picture.placement == picture.placement
    again = tmp_path / "again.insole"
    write_case(read, again)
    assert again.read_bytes() == file.read_bytes()
    write_case(read.with_foot(with_pressure(first, None)), again)
    assert read_case(again).feet[0].plantar.pressure is None


def test_a_map_moves_with_its_foot(left_foot: Foot) -> None:
    kpa = pressed(left_foot, Placement(5, 120, 20), np.random.default_rng(3)).kpa
    record = with_pressure(
        FootRecord.begun(left_foot, _SOURCE),
        PressureMap(kpa, (5.0, 5.0), Placement(5, 120, 20)),
    )
    turned = lying_anew(record, quarter_turned(left_foot, 2, 1))
    before, after = record.plantar.pressure, turned.plantar.pressure
    assert before is not None
    assert after is not None
    step = turned.foot.source2insole @ np.linalg.inv(left_foot.source2insole)
    points = before.placement.to_insole(np.array([[10.0, 20.0], [-30.0, 5.0]]))
    moved = np.column_stack([points, np.zeros(2)]) @ step[:3, :3].T + step[:3, 3]
    found = after.placement.to_insole(np.array([[10.0, 20.0], [-30.0, 5.0]]))
    assert np.abs(found - moved[:, :2]).max() < 0.05
