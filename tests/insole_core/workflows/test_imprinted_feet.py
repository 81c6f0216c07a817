"""From the scan of a foam box to feet: sides, form, what is doubted, what is proposed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import CaseRecord, FootRecord
from insole_core.cases.scan_source import ImportChoice
from insole_core.foot.foot_candidate import FoundFoot, PoseClicks
from insole_core.foot.landmarks import find_landmarks
from insole_core.foot.measures import doubts
from insole_core.formats.ply import write_ply
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid, rotation_about, rotation_angle_deg, transform
from insole_core.imprints.foam_box import find_imprints
from insole_core.imprints.form import Form
from insole_core.insole.build import build_insole
from insole_core.insole.warnings.finish_warnings import finish_warnings
from insole_core.scans.scale import KnownFootLength
from insole_core.workflows.clinic_devices import clinic_devices, find_device
from insole_core.workflows.clinic_tables import ClinicMaterials
from insole_core.workflows.import_scan import ScanExamination, examine_scan, take_foot
from insole_core.workflows.open_scan import open_scan
from insole_core.workflows.scanned_feet import ScannedFoot
from insole_core.workflows.starting_design import StartingDevice
from tests.insole_core.imprints.boxes import double_box, flat_cast, pressed, single_box

TURN = rigid(rotation_about(np.array([1.0, -0.4, 2.0]), 100.0), np.array([50.0, 400.0, -90.0]))


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Callable[[TriangleMesh], Path]:
    folder = tmp_path_factory.mktemp("boxes")

    def write(mesh: TriangleMesh) -> Path:
        path = folder / f"{len(list(folder.iterdir()))}.ply"
        write_ply(mesh, path)
        return path

    return write


@pytest.fixture(scope="module")
def box(left_mesh) -> TriangleMesh:
    """A foam box with one foot."""
    return single_box(left_mesh, cell_mm=2.0)


@pytest.fixture(scope="module")
def single(box, written) -> Path:
    return written(box.transformed(TURN))


@pytest.fixture(scope="module")
def examined(single) -> ScanExamination:
    return examine_scan(single)


@pytest.fixture(scope="module")
def double(left_mesh, right_mesh, written) -> Path:
    """The scan of a box with both feet."""
    return written(double_box([left_mesh, right_mesh], cell_mm=2.0).transformed(TURN))


@pytest.fixture(scope="module")
def both_examined(double) -> ScanExamination:
    return examine_scan(double)


def first_taken(examination: ScanExamination, number: int = 0) -> ScannedFoot:
    found = examination.feet[number]
    return take_foot(examination, found, found.candidates[0])


def test_the_foot_of_an_imprint_lies_where_it_was_pressed_in(examined, left_mesh):
    assert examined.form is Form.IMPRINT
    assert examined.feet[0].doubts == ()
    scanned = first_taken(examined)
    assert scanned.foot.side is Side.LEFT
    assert scanned.foot.length_mm == pytest.approx(245, abs=4)
    assert (scanned.foot.form, scanned.source.form) == (Form.IMPRINT, Form.IMPRINT)
    truth = transform(TURN, pressed(left_mesh).vertices)
    sole = transform(scanned.foot.source2insole, truth)
    assert sole[:, 2].min() == pytest.approx(0, abs=0.6)
    assert any("mm deep, read as the sole" in note for note in scanned.foot.notes)


def test_an_imprint_opens_by_command_and_makes_an_insole(single):
    scanned = open_scan(single, Side.LEFT)

    devices = clinic_devices(single.parent).load().items
    device = find_device(devices, "EVA, full length")
    design = StartingDevice(device, ClinicMaterials(single.parent).load()[0]).design(scanned.foot)
    insole = build_insole(scanned.foot, design)
    assert np.isfinite(insole.contact.heights_mm).all()
    assert insole.contact.heights_mm.max() < 45


def test_the_sides_of_an_imprint_are_no_cropped_ends(examined):
    marks = find_landmarks(first_taken(examined).foot)
    assert not {"ball_width", "heel_width", "arch_height"} & set(doubts(marks))


def test_the_walls_of_a_shallow_imprint_end_before_the_sides_do(left_mesh, written):
    shallow = examine_scan(written(single_box(left_mesh, 14.0, cell_mm=2.0)))
    assert {"ball_width", "heel_width"} <= set(doubts(find_landmarks(first_taken(shallow).foot)))


def test_both_feet_of_a_box_are_found_left_first(double, both_examined):
    assert [found.candidates[0].side for found in both_examined.feet] == [Side.LEFT, Side.RIGHT]
    assert all(found.doubts == () for found in both_examined.feet)
    assert open_scan(double, Side.RIGHT).foot.side is Side.RIGHT


def test_shapes_that_contradict_their_places_are_doubted(left_mesh, right_mesh, written):
    examination = examine_scan(written(double_box([right_mesh, left_mesh], cell_mm=2.0)))

    for found in examination.feet:
        assert any("by its shape" in doubt for doubt in found.doubts)


def test_a_sole_that_stands_out_is_asked_and_keeps_its_side(box, written):
    path = written(box.flipped())

    asked = examine_scan(path)
    said = examine_scan(path, ImportChoice(form=Form.IMPRINT))
    foot = examine_scan(path, ImportChoice(form=Form.FOOT))

    assert any("inside out" in doubt for doubt in asked.feet[0].doubts)
    assert said.feet[0].doubts == foot.feet[0].doubts == ()
    assert (said.form, foot.form) == (Form.IMPRINT, Form.FOOT)
    for examination in (asked, said, foot):
        assert examination.feet[0].candidates[0].side is Side.LEFT


def test_no_expansion_is_proposed_for_an_imprint(single, examined, left_foot):
    devices = clinic_devices(single.parent).load().items
    device = find_device(devices, "EVA, full length")
    finish = replace(device.values.finish, expansion_mm=2.0)
    device = replace(device, values=replace(device.values, finish=finish))
    starting = StartingDevice(device, ClinicMaterials(single.parent).load()[0])
    foot = first_taken(examined).foot

    assert starting.design(left_foot).finish.expansion_mm == 2.0
    design = starting.design(foot)
    assert design.finish.expansion_mm == 0.0
    asked = replace(design, finish=replace(design.finish, expansion_mm=2.0))
    warned = [warning.sentence for warning in finish_warnings(build_insole(foot, asked))]
    assert any("spread already" in sentence for sentence in warned)
    unloaded = replace(foot, form=Form.UNLOADED_CAST)
    assert starting.design(unloaded).finish.expansion_mm == 2.0
    warned = [warning.sentence for warning in finish_warnings(build_insole(unloaded, asked))]
    assert not any("spread already" in sentence for sentence in warned)


def test_a_case_keeps_the_form_of_its_scan(examined, tmp_path):
    scanned = first_taken(examined)
    record = CaseRecord.of_foot(FootRecord.begun(scanned.foot, scanned.source))

    write_case(record, tmp_path / "case.insole")
    kept = read_case(tmp_path / "case.insole")

    assert kept.source.form is Form.IMPRINT
    assert kept.foot.form is Form.IMPRINT


@pytest.mark.parametrize("lifted_deg", [3.0, -3.0])
def test_an_end_that_was_hardly_pressed_in_is_told(left_mesh, written, lifted_deg):
    lift = rotation_about(np.array([1.0, 0.0, 0.0]), lifted_deg)
    tilted = left_mesh.transformed(rigid(lift, np.zeros(3)))
    standing = tilted.transformed(rigid(np.eye(3), -tilted.bounds_mm[0] * [0, 0, 1]))

    (found,) = examine_scan(written(single_box(standing, 16.0, cell_mm=2.0))).feet

    assert any("hardly pressed in" in doubt for doubt in found.doubts)


def test_a_known_length_gives_the_scale_of_a_box(box, written):
    path = written(replace(box, vertices=box.vertices * 0.0137))

    examination = examine_scan(path, ImportChoice(known_size=KnownFootLength(246.0)))

    (found,) = examination.feet
    assert examination.form is Form.IMPRINT
    assert found.candidates[0].length_mm == pytest.approx(246, abs=1.5)


def test_boxes_in_a_folder_are_both_feet(left_mesh, right_mesh, written, tmp_path):
    for name, foot, x_mm in (("left", left_mesh, 0.0), ("right", right_mesh, 400.0)):
        place = rigid(np.eye(3), np.array([x_mm, 0.0, 0.0]))
        box = single_box(foot, cell_mm=2.0).transformed(place)
        written(box).rename(tmp_path / f"{name}.ply")

    examination = examine_scan(tmp_path)

    assert examination.form is Form.IMPRINT
    assert [found.candidates[0].side for found in examination.feet] == [Side.LEFT, Side.RIGHT]

    clicks = clicked_on_sole(examination.feet[1])
    left, right = examine_scan(tmp_path, ImportChoice(pose=clicks)).feet
    assert any("were clicked" in note for note in right.notes)
    assert not any("were clicked" in note for note in left.notes)
    assert (left.clicks, right.clicks) == (None, clicks)


def clicked_on_sole(found: FoundFoot) -> PoseClicks:
    """Heel, toe and ball of an imprint that was found."""
    to_source = np.linalg.inv(found.candidates[0].source2insole)
    places = np.array([(0.0, 3.0, 12.0), (-8.0, 238.0, 9.0), (0.0, 160.0, 3.0)])
    heel, toe, sole = (tuple(map(float, place)) for place in transform(to_source, places))
    return PoseClicks(heel, toe, sole)


def test_a_cast_is_what_the_user_says(left_mesh, left_foot, written):
    examination = examine_scan(written(left_mesh), ImportChoice(form=Form.CAST))

    scanned = first_taken(examination)
    assert scanned.foot.form is Form.CAST
    assert scanned.foot.length_mm == pytest.approx(left_foot.length_mm, abs=0.5)
    assert any("cast taken under weight" in note for note in scanned.foot.notes)


def test_an_imprint_without_its_rim_is_asked_for_its_form(box, written):
    scan = find_imprints(box)
    assert scan is not None
    (imprint,) = scan.imprints

    as_scanned = examine_scan(written(imprint.mesh.flipped())).feet[0]
    as_foot = examine_scan(written(imprint.mesh)).feet[0]

    assert any("rim was cut off" in doubt for doubt in as_scanned.doubts)
    assert not any("rim was cut off" in doubt for doubt in as_foot.doubts)
    assert as_scanned.told_side is as_foot.told_side is Side.LEFT


def test_a_low_cast_with_a_flat_top_lies_as_a_foot_does(left_mesh, written):
    path = written(flat_cast(left_mesh, 42.0).transformed(TURN))

    (found,) = examine_scan(path, ImportChoice(form=Form.CAST)).feet

    assert found.told_side is Side.LEFT
    assert found.candidates[0].length_mm == pytest.approx(245, abs=3)


def test_three_clicks_place_the_foot_of_an_imprint(double, both_examined):
    _, right = both_examined.feet

    clicked = examine_scan(double, ImportChoice(pose=clicked_on_sole(right))).feet

    assert [found.candidates[0].side for found in clicked] == [Side.LEFT, Side.RIGHT]
    to_source = np.linalg.inv(right.candidates[0].source2insole)
    turned = clicked[1].candidates[0].source2insole @ to_source
    assert rotation_angle_deg(turned[:3, :3]) < 2.0
