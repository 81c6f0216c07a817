"""One builder for preview, export, comparison and commands."""

from __future__ import annotations

import gc
import weakref
from concurrent.futures import ThreadPoolExecutor
from dataclasses import fields, replace

import numpy as np
import pytest
from scipy.spatial import KDTree

from insole_core.errors import DesignError
from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.elements import CORRECTION_TYPES, BrushStroke, Pelott, Posting, Rocker
from insole_core.insole.finishing.thin_plate import Plate
from insole_core.insole.prescription.base_form import BaseForm, Form
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Post, Shell
from insole_core.progress import Cancelled, Progress
from insole_core.solids.solid import insole_solid
from insole_core.workflows.edited_insole import EditedInsole
from insole_core.workflows.insole_builder import InsoleBuilder, bare_key

PAD = Pelott(centre_mm=(2.0, 130.0))
PLAIN = InsoleDesign(Side.LEFT, (PAD,), grid_mm=1.0, thickness_mm=3.0)
RECESS = replace(PAD, centre_mm=(0.0, 180.0), height_mm=-6.0)
ROUND = (
    RimStation(border="medial", along=0.0, height_mm=12.0),
    RimStation(border="medial", along=0.45, height_mm=12.0),
    RimStation(border="medial", along=0.8, height_mm=2.0, over="toes"),
    RimStation(border="lateral", along=0.45, height_mm=9.0),
    RimStation(border="lateral", along=0.8, height_mm=2.0, over="toes"),
)
FINISHED = replace(PLAIN, finish=Finish(rim=ROUND))


def with_arch(height_mm: float) -> InsoleDesign:
    """Return the finished design with another height of its medial arch."""
    rim = (ROUND[0], replace(ROUND[1], height_mm=height_mm), *ROUND[2:])
    return replace(FINISHED, finish=Finish(rim=rim))


FORM = Form(
    name="Flat",
    source="",
    length_mm=250.0,
    ball_width_mm=95.0,
    along_shares=(0.0, 0.3, 0.7, 1.0),
    across_shares=(0.0, 0.3, 0.7, 1.0),
    heights_mm=((4.0, 2.0, 2.0, 3.0),) * 4,
)


OTHER_VALUES = {
    "thickness_mm": 4.0,
    "grid_mm": 2.0,
    "max_height_mm": 20.0,
    "margin_mm": 8.0,
    "outline": Outline(extent="three_quarter"),
    "layers": Layers(cover_mm=6.0),
    "bottom": "following",
    "base": BaseForm(form=FORM, contact_share=0.5),
    "finish": Finish(),
    "shell": Shell(),
}


@pytest.fixture
def builder() -> InsoleBuilder:
    return InsoleBuilder()


@pytest.fixture
def edited(builder: InsoleBuilder, left_foot: Foot) -> EditedInsole:
    return EditedInsole(builder.bare(left_foot, PLAIN), PLAIN)


def assert_on_contact(edited: EditedInsole) -> None:
    """Let the top within its rim, which is cut as it is made, lie on the contact surface."""
    inner = np.setdiff1d(np.arange(edited.bare.top_count), edited.bare.rim)
    top = edited.mesh.vertices[inner]
    np.testing.assert_allclose(top[:, 2], edited.contact.height_at(top[:, :2]), rtol=0, atol=1e-9)


def test_the_builder_builds_what_the_pure_function_builds(
    builder: InsoleBuilder, left_foot: Foot
) -> None:
    design = PLAIN.with_added(Posting(rearfoot_deg=3.0))
    pure = build_insole(left_foot, design)
    for _ in range(2):  # the second time from what was kept
        insole, solid = builder.solid(left_foot, design)
        assert np.array_equal(insole.contact.heights_mm, pure.contact.heights_mm)
        assert np.array_equal(solid.vertices, insole_solid(pure).vertices)


def test_steps_are_kept_for_designs_that_share_them(
    builder: InsoleBuilder, left_foot: Foot
) -> None:
    bare = builder.bare(left_foot, PLAIN)
    other_pad = PLAIN.with_changed(replace(PAD, height_mm=2.0))
    assert builder.known_bare(left_foot, other_pad) is bare
    assert builder.base(left_foot, other_pad) is bare.base
    assert builder.known_bare(left_foot, PLAIN.with_added(Posting(rearfoot_deg=3.0))) is None
    assert builder.known_bare(replace(left_foot), PLAIN) is None


def test_devices_are_changed_to_and_fro_without_building_again(
    builder: InsoleBuilder, left_foot: Foot, monkeypatch: pytest.MonkeyPatch
) -> None:
    designs = [with_arch(10.0 + 2 * number) for number in range(6)]
    built = [builder.bare(left_foot, design) for design in designs]
    factorised: list[object] = []
    plain = Plate.on_springs
    monkeypatch.setattr(
        Plate, "on_springs", lambda plate, s: factorised.append(s) or plain(plate, s)
    )
    assert [builder.bare(left_foot, design) for design in designs] == built
    builder.forget()  # the plates are kept with the foot
    builder.bare(left_foot, designs[0])
    assert factorised == []


def test_a_shell_is_previewed_as_it_is_made(builder: InsoleBuilder, left_foot: Foot) -> None:
    posts = (Post(angle_deg=4.0), Post(region="forefoot", angle_deg=-3.0))
    design = InsoleDesign(
        Side.LEFT,
        bottom="following",
        outline=Outline(extent="three_quarter"),
        layers=Layers(cover_mm=2.0, cover_is_taken_off=True),
        shell=Shell(posts=posts, heel_pitch_mm=12.0, edge_radius_mm=1.5),
    )
    edited = EditedInsole(builder.bare(left_foot, design), design)
    solid = insole_solid(build_insole(left_foot, design))
    count = len(solid.vertices)
    np.testing.assert_allclose(edited.mesh.vertices[:count], solid.vertices, rtol=0, atol=1e-9)
    padded = design.with_added(PAD)
    assert edited.can_follow(left_foot, padded)
    before = edited.mesh.vertices[: count // 2, 2].copy()
    edited.follow(padded)
    risen = edited.mesh.vertices[: count // 2, 2] - before
    assert risen.max() == pytest.approx(PAD.height_mm, abs=0.1)
    assert (risen[np.hypot(*(solid.vertices[: count // 2, :2] - PAD.centre_mm).T) > 35] == 0).all()
    # The foot stands on the cover, on which it was to stand.
    standing = edited.standing_foot.vertices
    gap = standing[:, 2] - edited.heights_mm(standing[:, :2])
    near = (np.abs(standing[:, 1] - 40) < 20) & (np.abs(standing[:, 0]) < 10)
    assert gap[near].min() == pytest.approx(0, abs=0.7)


@pytest.mark.parametrize(
    "shell",
    [
        Shell(heel_pitch_mm=10.0),
        Shell(posts=(Post(),)),
        Shell(taper_mm=2.0),
        Shell(trim_mm=((35.0, 150.0), (-30.0, 140.0))),
    ],
)
def test_a_changed_shell_is_built_anew(
    builder: InsoleBuilder, left_foot: Foot, shell: Shell
) -> None:
    design = replace(PLAIN, outline=Outline(extent="three_quarter"), shell=Shell())
    bare = builder.bare(left_foot, design)
    changed = replace(design, shell=shell, bottom="following" if shell.posts else "flat")
    assert builder.known_bare(left_foot, changed) is None
    assert not np.array_equal(builder.bare(left_foot, changed).solid.vertices, bare.solid.vertices)


def test_nothing_is_kept_of_a_closed_case_even_if_it_is_still_being_built(
    builder: InsoleBuilder, left_foot: Foot
) -> None:
    foot = replace(left_foot)
    reported: list[str] = []

    def close_meanwhile(_fraction: float, text: str) -> None:
        if not reported:
            builder.forget()
        reported.append(text)

    builder.bare(foot, PLAIN, Progress(close_meanwhile))
    assert reported
    assert builder.known_bare(foot, PLAIN) is None
    gone = weakref.ref(foot)
    del foot
    gc.collect()
    assert gone() is None


def test_a_cancelled_step_is_not_kept(builder: InsoleBuilder, left_foot: Foot) -> None:
    with pytest.raises(Cancelled):
        builder.bare(left_foot, PLAIN, Progress(is_cancelled=lambda: True))
    assert builder.known_bare(left_foot, PLAIN) is None
    assert builder.bare(left_foot, PLAIN).base.surface.heights_mm.min() > 0


def test_threads_that_build_at_once_get_the_same_insole(
    builder: InsoleBuilder, left_foot: Foot
) -> None:
    foot = replace(left_foot)
    coarse = replace(PLAIN, grid_mm=2.0)
    with ThreadPoolExecutor(2) as pool:
        built = list(pool.map(lambda _: builder.bare(foot, coarse), range(2)))
    assert all(one is built[0] for one in built)


def test_an_edited_insole_is_that_of_a_full_rebuild(edited: EditedInsole, left_foot: Foot) -> None:
    for x_mm, height_mm in ((5.0, 6.0), (-8.0, 6.0), (-8.0, 2.0)):
        design = PLAIN.with_changed(replace(PAD, centre_mm=(x_mm, 140.0), height_mm=height_mm))
        assert edited.can_follow(left_foot, design)
        edited.follow(design)
        whole = EditedInsole(edited.bare, design)
        rebuilt = build_insole(left_foot, design)
        assert np.array_equal(edited.contact.heights_mm, rebuilt.contact.heights_mm)
        assert np.array_equal(edited.mesh.vertices, whole.mesh.vertices)
        assert np.allclose(edited.normals, whole.normals, atol=1e-12)
        assert_on_contact(edited)
    assert not edited.can_follow(left_foot, PLAIN.with_added(Posting(rearfoot_deg=3.0)))


def test_a_dragged_rim_is_followed_closely_and_exact_again_at_its_old_place(
    builder: InsoleBuilder, left_foot: Foot
) -> None:
    edited = EditedInsole(builder.bare(left_foot, FINISHED), FINISHED)
    start = edited.mesh.vertices.copy()
    for height_mm in (13.0, 15.0):
        dragged = with_arch(height_mm)
        assert not edited.can_follow(left_foot, dragged)
        assert edited.can_follow_finish(left_foot, dragged)
        edited.follow(dragged)
        assert not edited.is_exact
        exact = builder.insole(left_foot, dragged).contact
        assert np.abs(edited.contact.heights_mm - exact.heights_mm).max() < 1.0
        assert_on_contact(edited)
    edited.follow(FINISHED)
    assert edited.is_exact
    assert np.array_equal(edited.mesh.vertices, start)


def test_a_pad_moves_on_a_dragged_rim(builder: InsoleBuilder, left_foot: Foot) -> None:
    edited = EditedInsole(builder.bare(left_foot, FINISHED), FINISHED)
    edited.follow(with_arch(14.0))
    below = edited.base.surface.heights_mm
    higher = with_arch(14.0).with_changed(replace(PAD, height_mm=7.0))
    edited.follow(higher)
    assert edited.base.surface.heights_mm is below
    assert (edited.contact.heights_mm - below).max() == pytest.approx(7.0, abs=0.1)


def test_a_rim_that_contradicts_itself_is_told_and_leaves_the_surface(
    builder: InsoleBuilder, left_foot: Foot
) -> None:
    edited = EditedInsole(builder.bare(left_foot, FINISHED), FINISHED)
    twice = replace(
        FINISHED, finish=Finish(rim=(*ROUND, replace(ROUND[0], border="lateral", height_mm=20.0)))
    )
    before = edited.contact
    edited.follow(twice)
    assert "at the same place" in edited.problem
    assert edited.contact is before
    edited.follow(FINISHED)
    assert edited.problem == ""


ON_FORM = replace(FINISHED, base=BaseForm(form=FORM, contact_share=0.5))


@pytest.mark.parametrize(
    ("start", "changed"),
    [
        (FINISHED, replace(FINISHED, finish=replace(FINISHED.finish, arch_fill_mm=3.0))),
        (FINISHED, replace(FINISHED, finish=replace(FINISHED.finish, toe_line_mm=12.0))),
        (FINISHED, replace(FINISHED, finish=replace(FINISHED.finish, toe_zone="as_scanned"))),
        (ON_FORM, replace(ON_FORM, base=BaseForm(form=FORM, contact_share=0.2))),
    ],
    ids=["fill", "toe line", "toe zone", "share of the foot"],
)
def test_the_finish_is_followed_closely_and_exact_again_at_its_old_values(
    builder: InsoleBuilder, left_foot: Foot, start: InsoleDesign, changed: InsoleDesign
) -> None:
    edited = EditedInsole(builder.bare(left_foot, start), start)
    vertices = edited.mesh.vertices.copy()
    assert edited.can_follow_finish(left_foot, changed)
    edited.follow(changed)
    assert not edited.is_exact
    exact = builder.bare(left_foot, changed)
    xy = exact.solid.vertices[: exact.top_count, :2]
    off = np.abs(
        edited.contact.height_at(xy) - builder.insole(left_foot, changed).contact.height_at(xy)
    )
    moved = np.abs(edited.mesh.vertices[:, 2] - vertices[:, 2])
    assert moved.max() > 1.0, "the change is seen"
    assert off.max() < 1.0
    assert np.quantile(off, 0.95) < 0.2
    edited.follow(start)
    assert edited.is_exact
    assert np.array_equal(edited.mesh.vertices, vertices)


def test_what_is_no_finish_is_not_followed(builder: InsoleBuilder, left_foot: Foot) -> None:
    edited = EditedInsole(builder.bare(left_foot, FINISHED), FINISHED)
    assert not edited.can_follow_finish(replace(left_foot), with_arch(14.0))
    assert not edited.can_follow_finish(left_foot, replace(FINISHED, thickness_mm=4.0))
    assert not edited.can_follow_finish(left_foot, PLAIN)
    assert not edited.can_follow_finish(left_foot, ON_FORM)
    plain = EditedInsole(builder.bare(left_foot, PLAIN), PLAIN)
    assert not plain.can_follow_finish(left_foot, FINISHED)


CUPPED = replace(
    FINISHED,
    corrections=(),
    bottom="following",
    outline=Outline(extent="three_quarter"),
    shell=Shell(posts=(Post(angle_deg=4.0),), edge_radius_mm=1.0),
)


@pytest.mark.parametrize(
    "design",
    [
        CUPPED,
        replace(CUPPED, shell=None, outline=Outline()),
        replace(CUPPED, layers=Layers(cover_mm=2.0, cover_is_taken_off=True)),
        replace(CUPPED, bottom="flat", corrections=(Rocker(behind_heads_mm=20.0),)),
        replace(CUPPED, shell=Shell(heel_pitch_mm=12.0), outline=Outline()),
        replace(CUPPED, shell=Shell(draft_medial_deg=-12.0, draft_lateral_deg=-8.0)),
    ],
    ids=["cupped", "without shell", "cover taken off", "rocker", "heel pitch", "inward walls"],
)
def test_under_a_pad_the_preview_is_what_is_made(
    builder: InsoleBuilder, left_foot: Foot, design: InsoleDesign
) -> None:
    pad = replace(PAD, centre_mm=(22.0, 110.0), height_mm=7.0)
    padded, away = design.with_added(pad), design.with_added(replace(pad, centre_mm=(0.0, 60.0)))
    bare = builder.bare(left_foot, design)
    edited = EditedInsole(bare, away)
    in_the_middle = design.with_added(replace(pad, centre_mm=(2.0, 110.0), height_mm=5.0))
    leans = design.shell is not None and design.shell.draft_medial_deg < 0
    # An edge that a pad has lifted is made anew only once the drag is over.
    for during, most_mm, usual_mm in ((in_the_middle, 0.02, 1e-6), (padded, 0.4, 0.03)):
        edited.follow(during)
        solid = insole_solid(build_insole(left_foot, during)).vertices
        for face in (0, 1):
            same, off_mm = _off_at_same_place(solid, edited.mesh.vertices, bare.top_count, face)
            assert same > (0.4 if leans and face == 1 else 0.93)
            assert off_mm.max() < most_mm
            assert np.quantile(off_mm, 0.99) < usual_mm
    apart, _ = KDTree(solid).query(edited.mesh.vertices)
    assert np.quantile(apart, 0.5) < 1e-6, "all but edges and walls"
    before = edited.mesh.vertices.copy()
    assert edited.settle()
    apart, _ = KDTree(solid).query(edited.mesh.vertices)
    assert apart.max() < 1e-6
    assert edited.moved is not None
    still = np.setdiff1d(np.arange(len(before)), edited.moved)
    np.testing.assert_allclose(edited.mesh.vertices[still], before[still], rtol=0, atol=1e-9)
    assert not edited.settle()
    count = bare.top_count
    risen = edited.bottom_heights_mm - bare.solid.vertices[count : 2 * count, 2]
    assert (risen.max() > 3.0) == (design.bottom == "following")
    again = EditedInsole(bare, padded)
    again.settle()
    assert np.allclose(edited.mesh.vertices, again.mesh.vertices, atol=1e-9)
    assert np.allclose(edited.normals, again.normals, atol=1e-9)
    skin = edited.skins[1]
    assert np.array_equal(skin.vertices, edited.mesh.vertices), "the section shows it too"


def _off_at_same_place(
    made: FloatArray, shown: FloatArray, count: int, face: int
) -> tuple[float, FloatArray]:
    """Return how much of a face, 0 the top one, is seen where it is made, and how far off there.

    The walls lean by as much as they are high, so that the rim of the bottom may be elsewhere.
    """
    half = len(made) // 2
    of_face = made[face * half : (face + 1) * half]
    seen = shown[face * count : (face + 1) * count]
    apart, nearest = KDTree(of_face[:, :2]).query(seen[:, :2])
    same = apart < 1e-6
    return float(same.mean()), np.abs(seen[same, 2] - of_face[nearest[same], 2])


@pytest.mark.parametrize("bottom", ["flat", "following"])
def test_a_stroke_across_a_pad_leaves_no_groove(
    builder: InsoleBuilder, left_foot: Foot, bottom: str
) -> None:
    shell = Shell(taper_mm=2.0, edge_radius_mm=1.0)
    design = replace(FINISHED, bottom=bottom, shell=shell)
    bare = builder.bare(left_foot, design)
    edited = EditedInsole(bare, design)
    stroke = BrushStroke(points_mm=((-18.0, 128.0),))
    for number in range(1, 7):
        points = (*stroke.points_mm, (-18.0 + 8.0 * number, 128.0 + 3.0 * number))
        stroke = replace(stroke, points_mm=points)
        edited.follow(design.with_added(stroke))
    for now in (edited.design, design):
        edited.follow(now)
        whole = EditedInsole(bare, now)
        for seen, made in (
            (edited.mesh.vertices, whole.mesh.vertices),
            (edited.normals, edited.mesh.vertex_normals),
        ):
            np.testing.assert_allclose(seen, made, rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    "changed",
    [
        replace(PLAIN, **{field.name: value})
        for field in fields(InsoleDesign)
        if (value := OTHER_VALUES.get(field.name)) is not None
    ],
)
def test_a_changed_value_asks_for_another_insole(left_foot: Foot, changed: InsoleDesign) -> None:
    assert bare_key(left_foot, changed) != bare_key(left_foot, PLAIN)


def test_what_asks_for_no_other_insole_is_named() -> None:
    assert {field.name for field in fields(InsoleDesign)} - OTHER_VALUES.keys() == {
        "side",  # the foot's
        "corrections",  # below
        "device",  # a name
    }
    stages = {kind.type: kind.stage for kind in CORRECTION_TYPES.values()}
    followed = {name for name, stage in stages.items() if stage == "pad"}
    assert followed == {"pelott", "arch_raise", "brush"}, "what is added can be followed"
    assert set(stages.values()) == {"turn", "sole", "pad", "body"}


def test_what_is_too_thin_is_told_by_every_step_in_the_same_words(
    builder: InsoleBuilder, edited: EditedInsole, left_foot: Foot
) -> None:
    assert edited.problem == ""
    thin = PLAIN.with_changed(RECESS)
    edited.follow(thin)
    assert "mm thick at x = " in edited.problem
    for build in (build_insole, builder.insole, builder.solid):
        with pytest.raises(DesignError) as refused:
            build(left_foot, thin)
        assert str(refused.value) == edited.problem
    edited.follow(PLAIN)
    assert edited.problem == ""


@pytest.mark.parametrize(
    ("design", "sentence"),
    [
        (replace(PLAIN, side=Side.RIGHT), "is for a right foot"),
        (replace(PLAIN, thickness_mm=1000.0), "thickness_mm"),
    ],
)
def test_a_design_that_does_not_fit_is_refused_before_anything_is_built(
    builder: InsoleBuilder, left_foot: Foot, design: InsoleDesign, sentence: str
) -> None:
    for build in (builder.insole, builder.bare):
        with pytest.raises(DesignError, match=sentence):
            build(left_foot, design)
