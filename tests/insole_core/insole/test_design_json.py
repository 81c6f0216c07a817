"""The JSON form of a design: what comes back, what is refused; and its schema says the same."""

from __future__ import annotations

import copy
import json
from dataclasses import MISSING, fields, replace
from typing import Any

import design_schema
import jsonschema
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from insole_core.errors import DesignError, InputError
from insole_core.geometry.side import Side
from insole_core.insole.elements import CORRECTION_TYPES, ArchRaise, BrushStroke, Pelott, Posting
from insole_core.insole.fields import Range, choices_of, ranges_of
from insole_core.insole.pads.pad_form import FREE
from insole_core.insole.prescription.base_form import BaseForm, Form
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_json import (
    design_from_json,
    design_to_json,
    read_design,
)
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline, Shoe
from insole_core.insole.prescription.shell import Post, Shell

SCHEMA = json.loads(design_schema.SCHEMA.read_text("utf-8"))
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)
CONTRACT: dict[str, Any] = {
    "format": "insole-design", "version": 1, "side": "left",
    "corrections": [
        {"type": "pelott", "shape": "egg", "centre_mm": [12.0, 150.0], "length_mm": 60,
         "width_mm": 40, "height_mm": 6, "turn_deg": 0},
        {"type": "posting", "rearfoot_deg": 4, "forefoot_deg": 0},
    ],
    "thickness_mm": 3.0, "grid_mm": 0.5,
}  # fmt: skip


def within(limits: Range) -> st.SearchStrategy[float]:
    return st.floats(limits.least, limits.greatest)


def place(limits: Range) -> st.SearchStrategy[tuple[float, float]]:
    return st.tuples(within(limits), within(limits))


def correction(kind: type, /, **extra: Any) -> st.SearchStrategy[Any]:
    ranges = ranges_of(kind)
    numbers = {k: within(r) for k, r in ranges.items() if k not in extra}
    words = {k: st.sampled_from(v) for k, v in choices_of(kind).items() if k not in extra}
    zones = {k: st.floats(0, 0.5) for k in ranges if k.endswith("_start")}
    zones |= {k: st.floats(0.55, 1) for k in ranges if k.endswith("_end")}
    texts = {"author": st.text(max_size=8), "enabled": st.booleans()}
    return st.builds(kind, **{**numbers, **words, **zones, **texts, **extra})


PELOTT = ranges_of(Pelott)
SQUARE = ((-10.0, -10.0), (10.0, -10.0), (10.0, 12.0), (-10.0, 10.0))
PADS = correction(
    Pelott,
    shape=st.sampled_from([s for s in choices_of(Pelott)["shape"] if s not in FREE]),
    kind=st.none() | st.text(min_size=1, max_size=60),
    outline_mm=st.none(),
    centre_mm=place(PELOTT["centre_mm"]),
    sigma_mm=st.none() | place(PELOTT["sigma_mm"]),
    blend_mm=st.none() | within(PELOTT["blend_mm"]),
)
FREE_PADS = correction(
    Pelott,
    shape=st.sampled_from(FREE),
    outline_mm=st.just(SQUARE),
    centre_mm=place(PELOTT["centre_mm"]),
    sigma_mm=st.none(),
    blend_mm=st.none(),
)
STROKES = correction(
    BrushStroke,
    strength=st.floats(0, 1),
    points_mm=st.lists(place(ranges_of(BrushStroke)["points_mm"]), min_size=1, max_size=4).map(
        tuple
    ),
)
OTHERS = [
    correction(
        kind,
        **(
            {
                "apex_mm": st.none() | place(PELOTT["centre_mm"]),
                "target_mm": st.none() | within(ranges_of(ArchRaise)["target_mm"]),
            }
            if kind is ArchRaise
            else {}
        ),
    )
    for kind in CORRECTION_TYPES.values()
    if kind not in (Pelott, BrushStroke)
]
outlines = st.builds(
    Outline,
    source=st.sampled_from(["foot", "shoe_size", "drawn"]),
    extent=st.sampled_from(choices_of(Outline)["extent"]),
    points_mm=st.just(SQUARE),
    **{k: within(r) for k, r in ranges_of(Outline).items() if k != "points_mm"},
)
rim_stations = st.builds(
    RimStation,
    **{k: st.sampled_from(v) for k, v in choices_of(RimStation).items()},
    **{k: within(r) for k, r in ranges_of(RimStation).items()},
)
finishes = st.builds(
    Finish,
    toe_zone=st.sampled_from(choices_of(Finish)["toe_zone"]),
    rim=st.lists(rim_stations, max_size=4).map(tuple),
    **{k: within(r) for k, r in ranges_of(Finish).items()},
)
TRIM, HEIGHT = ranges_of(Shell)["trim_mm"], ranges_of(Form)["heights_mm"]
trim_lines = st.lists(st.integers(-400, 400), min_size=2, max_size=3, unique=True).flatmap(
    lambda x: st.tuples(*(st.tuples(st.just(float(v)), within(TRIM)) for v in x))
)
shells = st.builds(
    Shell,
    material=st.text(max_size=8),
    trim_mm=st.none() | trim_lines,
    posts=st.sampled_from(choices_of(Post)["region"]).flatmap(
        lambda region: st.tuples(
            st.builds(
                Post, region=st.just(region), **{k: within(r) for k, r in ranges_of(Post).items()}
            )
        )
    ),
    **{k: within(r) for k, r in ranges_of(Shell).items() if k != "trim_mm"},
)
SHARES = st.lists(st.integers(0, 100), min_size=4, max_size=6, unique=True).map(
    lambda shares: tuple(share / 100 for share in sorted(shares))
)
forms = st.tuples(SHARES, SHARES).flatmap(
    lambda shares: st.builds(
        Form,
        name=st.text(max_size=8),
        length_mm=within(ranges_of(Form)["length_mm"]),
        ball_width_mm=within(ranges_of(Form)["ball_width_mm"]),
        along_shares=st.just(shares[0]),
        across_shares=st.just(shares[1]),
        heights_mm=st.tuples(*(st.tuples(*(within(HEIGHT) for _ in shares[1])),) * len(shares[0])),
    )
)


def in_order(design: InsoleDesign) -> InsoleDesign:
    """The design with the points of its trim line from the medial to the lateral border."""
    if design.shell is None or design.shell.trim_mm is None:
        return design
    points = sorted(design.shell.trim_mm, key=lambda p: -design.side.medial_sign * p[0])
    return replace(design, shell=replace(design.shell, trim_mm=tuple(points)))


bases = st.builds(BaseForm, form=forms, contact_share=within(ranges_of(BaseForm)["contact_share"]))
designs = st.builds(
    InsoleDesign,
    side=st.sampled_from(Side),
    corrections=st.lists(st.one_of(PADS, FREE_PADS, STROKES, *OTHERS), max_size=4).map(tuple),
    outline=outlines,
    layers=st.builds(
        Layers,
        cover_is_taken_off=st.booleans(),
        **{k: within(r) for k, r in ranges_of(Layers).items()},
    ),
    bottom=st.sampled_from(choices_of(InsoleDesign)["bottom"]),
    device=st.text(max_size=8),
    base=st.none() | bases,
    finish=st.none() | finishes,
    shell=st.none() | shells,
    **{key: within(limits) for key, limits in ranges_of(InsoleDesign).items()},
).map(in_order)


def changed(*path: Any, value: Any) -> dict[str, Any]:
    """The contract's example with one value replaced or added."""
    content = copy.deepcopy(CONTRACT)
    *way, last = path
    place: Any = content
    for step in way:
        place = place[step]
    place[last] = value
    return content


def without(key: str) -> dict[str, Any]:
    return {k: v for k, v in CONTRACT.items() if k != key}


def test_example_of_the_contract_is_read():
    design = design_from_json(CONTRACT)
    assert design.side is Side.LEFT
    assert (design.thickness_mm, design.grid_mm) == (3.0, 0.5)
    pad, posting = design.corrections
    assert isinstance(pad, Pelott)
    assert (pad.centre_mm, pad.height_mm, pad.enabled) == ((12.0, 150.0), 6.0, True)
    assert isinstance(posting, Posting)
    assert (posting.rearfoot_deg, posting.forefoot_deg) == (4.0, 0.0)
    VALIDATOR.validate(CONTRACT)


@pytest.mark.slow
@given(design=designs)
@settings(max_examples=60, deadline=None)
def test_every_design_comes_back_and_obeys_the_schema(design):
    content = json.loads(json.dumps(design_to_json(design)))
    VALIDATOR.validate(content)
    assert design_from_json(content) == design


def test_the_schema_says_what_the_classes_declare() -> None:
    written = design_schema.written(design_schema.with_declared(SCHEMA)) + "\n"
    assert written == design_schema.SCHEMA.read_text("utf-8"), "run docs/design_schema.py"


def test_a_new_correction_is_described_by_what_it_declares() -> None:
    known = {name: part for name, part in SCHEMA["$defs"].items() if name != "arch_raise"}
    described = design_schema.with_declared({**SCHEMA, "$defs": known})
    assert described["$defs"]["arch_raise"] == SCHEMA["$defs"]["arch_raise"]


DESCRIBED = [
    (InsoleDesign, SCHEMA["properties"]),
    *(
        (kind, SCHEMA["$defs"][name]["properties"])
        for name, kind in {
            "outline": Outline, "shoe": Shoe, "layers": Layers, "base": BaseForm, "form": Form,
            "finish": Finish, "rim_station": RimStation, "shell": Shell, "post": Post,
            **CORRECTION_TYPES,
        }.items()
    ),
]  # fmt: skip
KINDS = [kind.__name__ for kind, _ in DESCRIBED]


@pytest.mark.parametrize(("kind", "described"), DESCRIBED, ids=KINDS)
def test_defaults_of_the_schema_are_those_of_the_values(kind, described):
    assert {f.name for f in fields(kind)} == described.keys() - {"format", "version", "type"}
    for field in fields(kind):
        default = None if field.default is MISSING else field.default
        if field.name != "corrections":
            assert described[field.name].get("default") == (default if default != () else None)


def _number_of(described: dict[str, Any]) -> dict[str, Any]:
    while "items" in described:
        described = described["items"]
    return described


@pytest.mark.parametrize(("kind", "described"), DESCRIBED, ids=KINDS)
def test_ranges_of_the_schema_are_those_of_the_reader(kind, described):
    ranges = ranges_of(kind)
    for key, limits in ranges.items():
        number = _number_of(described[key])
        assert (number["minimum"], number["maximum"]) == (limits.least, limits.greatest)
    assert {k for k, v in described.items() if "minimum" in _number_of(v)} == ranges.keys()
    words = {k: tuple(v["enum"]) for k, v in described.items() if "enum" in v and k != "side"}
    assert words == choices_of(kind)


BAD = [
    ([], "JSON object"),
    (without("format"), 'format must be "insole-design"'),
    (without("version"), "version must be 1"),
    (without("side"), '"side"'),
    (without("corrections"), '"corrections"'),
    (changed("version", value=2), "version 2.*newer"),
    (changed("version", value=True), "version must be 1"),
    (changed("side", value="both"), 'side must be "left" or "right", and is "both"'),
    (changed("thickness_mm", value=0.1), "thickness_mm is 0.1, and must be 0.5 to 40 mm"),
    (changed("thickness_mm", value=41), "thickness_mm is 41"),
    (changed("thickness_mm", value="3"), 'thickness_mm must be a number, and is "3"'),
    (changed("thickness_mm", value=True), "thickness_mm must be a number"),
    (changed("grid_mm", value=0), "grid_mm is 0, and must be 0.25 to 5 mm"),
    (changed("margin_mm", value=-1), "margin_mm is -1"),
    (changed("max_height_mm", value=200), "max_height_mm is 200"),
    (changed("comment", value="x"), '"comment".*does not know'),
    (changed("corrections", value={}), "corrections must be a list"),
    (changed("corrections", 0, value=7), r"corrections\[0\] must be a JSON object"),
    (changed("corrections", 0, "type", value="skive"), r"corrections\[0\].*\"skive\".*\"pelott\""),
    (changed("corrections", 0, "type", value=["pelott"]), "does not know"),
    (changed("corrections", 0, "heigth_mm", value=5), '"heigth_mm"'),
    (
        changed("corrections", 0, "height_mm", value=25),
        r"height_mm of corrections\[0\] \(pelott\) is 25, and must be -20 to 20 mm",
    ),
    (changed("corrections", 0, "centre_mm", value=[1.0]), "centre_mm.*two numbers"),
    (changed("corrections", 0, "centre_mm", value=[1.0, 999.0]), "centre_mm.*999"),
    (changed("corrections", 0, "shape", value="star"), 'shape.*"star"'),
    (changed("corrections", 0, "egg_ratio", value=1.5), "egg_ratio.*0 to 1;"),
    (changed("corrections", 0, "enabled", value=1), "enabled.*true or false"),
    (changed("corrections", 0, "author", value=1), "author.*must be a text"),
    (changed("corrections", 0, "kind", value=3), "kind.*must be a text"),
    (changed("corrections", 0, "kind", value=""), "kind.*has 0 letters, and must have 1 to 60"),
    (changed("corrections", 0, "kind", value="a" * 61), "kind.*has 61 letters"),
    (changed("corrections", 0, "shape", value="flat_outline"), "outline_mm.*belongs"),
    (changed("corrections", 0, "target_mm", value=30), "target_mm.*does not know"),
    (
        changed("corrections", 1, value={"type": "arch_raise", "target_mm": 61}),
        "target_mm.*is 61, and must be 0 to 60 mm",
    ),
    (
        changed("corrections", 1, "rearfoot_deg", value=-16),
        r"rearfoot_deg of corrections\[1\] \(posting\) is -16, and must be -15 to 15 degrees",
    ),
    (changed("corrections", 0, value={"type": "pelott"}), 'lacks the key "centre_mm"'),
    (changed("finish", value=[]), "finish must be a JSON object"),
    (changed("finish", value={"rim": {}}), "rim of finish must be a list of objects"),
    (changed("finish", value={"rim": [7]}), r"rim of finish\[0\] must be a JSON object"),
    (
        changed("finish", value={"rim": [{"border": "medial", "along": 0.1}]}),
        'lacks the key "height_mm"',
    ),
    (
        changed("finish", value={"rim": [{"border": "inner", "along": 0.1, "height_mm": 9}]}),
        r'border of rim\[0\] is "inner"',
    ),
    (changed("finish", value={"toe_zone": "round"}), 'toe_zone of finish is "round"'),
    (changed("shell", value={"body_weight_kg": 700}), "body_weight_kg of shell is 700"),
    (changed("shell", value={"posts": [{"angle_deg": 40}]}), r"angle_deg of posts\[0\] is 40"),
    (changed("layers", value={"cover_is_taken_off": 1}), "cover_is_taken_off.*true or false"),
    (changed("device", value=7), "device must be a text"),
]


@pytest.mark.parametrize(("content", "reason"), BAD, ids=range(len(BAD)))
def test_reader_and_schema_refuse_the_same(content, reason):
    with pytest.raises(DesignError, match=reason):
        design_from_json(content)
    assert not VALIDATOR.is_valid(content)


def test_trim_line_goes_from_medial_to_lateral():
    for side, sign in (("left", 1), ("right", -1)):
        points = [[sign * x, y] for x, y in ((40, 160), (0, 170), (-30, 165))]
        content = {**changed("shell", value={"trim_mm": points}), "side": side}
        assert design_from_json(content).shell is not None
        points[2][0] = sign * 10
        with pytest.raises(DesignError, match="turns back or crosses itself at its point 3"):
            design_from_json(content)


def test_a_file_without_the_newer_keys_keeps_its_meaning():
    pad, arch = design_from_json(
        changed("corrections", value=[
            {"type": "pelott", "centre_mm": [1, 2]}, {"type": "arch_raise", "height_mm": 5},
        ])
    ).corrections  # fmt: skip
    assert isinstance(pad, Pelott)
    assert (pad.height_mm, pad.kind) == (6.0, None)
    assert isinstance(arch, ArchRaise)
    assert (arch.height_mm, arch.target_mm) == (5.0, None)
    stored = design_to_json(InsoleDesign(Side.LEFT, (pad, arch)))["corrections"]
    assert all({"kind", "target_mm"}.isdisjoint(correction) for correction in stored)


def test_ids_must_differ():
    content = changed("corrections", 0, "id", value="a")
    content["corrections"][1]["id"] = "a"
    with pytest.raises(DesignError, match='two corrections have the id "a"'):
        design_from_json(content)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "no valid JSON"),
        ('{"format": "insole-design", ', "no valid JSON"),
        ("[" * 100_000, "no valid JSON"),
        (json.dumps(CONTRACT).replace("3.0", "NaN"), "NaN is no number"),
        (json.dumps(CONTRACT).replace("3.0", "1e999"), "thickness_mm is inf"),
        (json.dumps(CONTRACT).replace("3.0", "1" * 400), "thickness_mm is too large"),
        (
            json.dumps(CONTRACT).replace('"grid_mm"', '"thickness_mm"'),
            '"thickness_mm" stands twice',
        ),
        (json.dumps(without("side")), 'lacks the key "side"'),
    ],
    ids=range(8),
)
def test_file_that_cannot_be_used_is_refused_by_name(tmp_path, text, reason):
    path = tmp_path / "design.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=rf"(?s)design\.json.*{reason}"):
        read_design(path)


def test_missing_and_binary_files_are_refused(tmp_path):
    with pytest.raises(InputError, match=r"none\.json cannot be read"):
        read_design(tmp_path / "none.json")
    path = tmp_path / "design.json"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match="no UTF-8 text"):
        read_design(path)


def test_file_of_the_contract_is_read(tmp_path):
    path = tmp_path / "design.json"
    path.write_text(json.dumps(CONTRACT), encoding="utf-8")
    assert read_design(path).corrections[0].type == "pelott"
