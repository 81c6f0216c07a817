"""Findings and what they propose."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from insole_core.errors import DesignError, InputError
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.side import Side
from insole_core.insole.clinic_rules import load_rules
from insole_core.insole.elements import (
    CORRECTION_TYPES,
    ArchRaise,
    BrushStroke,
    HeelCup,
    HeelSkive,
    Pelott,
    Posting,
)
from insole_core.insole.elements.pad_places import placed_pad
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_differences import design_differences
from insole_core.insole.prescription.design_limits import check_design
from insole_core.insole.prescription.device import apply_device
from insole_core.insole.prescription.rim_sliders import cup_depth_mm, medial_flange_mm
from insole_core.workflows.clinic_devices import AS_SCANNED, DEFAULT_DEVICE, clinic_devices
from insole_core.workflows.clinic_findings import ClinicFindings, export_findings, read_findings
from insole_core.workflows.findings import (
    Catalogue,
    Finding,
    ProposedPad,
    apply_finding,
    find_finding,
)
from insole_core.workflows.kept_finding import finding_of
from insole_core.workflows.pad_library import load_pads

NOWHERE = Path("/nowhere")
FINDINGS = tuple(ClinicFindings(NOWHERE).load().items.values())
CATALOGUE = Catalogue(clinic_devices(NOWHERE).load().items, DEFAULT_DEVICE, load_pads(), 8.0)


def eva(side: Side) -> InsoleDesign:
    return apply_device(CATALOGUE.devices["eva-full-length"], InsoleDesign(side))


def proposed(name: str, design: InsoleDesign, foot) -> InsoleDesign:
    finding = find_finding(FINDINGS, name)
    return apply_finding(finding, design, find_landmarks(foot), CATALOGUE)


def lines(old: InsoleDesign, new: InsoleDesign) -> list[str]:
    told = (str(line) for line in design_differences(old, new))
    return [line for line in told if " rim, " not in line]


@pytest.mark.parametrize("finding", FINDINGS, ids=lambda finding: finding.name)
def test_every_finding_applies_once_to_both_feet(finding: Finding, left_foot, right_foot):
    assert finding.source
    made = []
    for foot in (left_foot, right_foot):
        design = eva(foot.side)
        once = apply_finding(finding, design, find_landmarks(foot), CATALOGUE)
        check_design(once)
        assert design_differences(design, once)
        assert apply_finding(finding, once, find_landmarks(foot), CATALOGUE) == once
        made.append(once)
    left, right = made
    assert replace(left, side=Side.RIGHT, corrections=()) == replace(right, corrections=())
    for a, b in zip(left.corrections, right.corrections, strict=True):
        assert a.type == b.type
        if isinstance(a, Pelott) and isinstance(b, Pelott):
            x, y = a.centre_mm
            assert b.centre_mm == pytest.approx((-x, y), abs=0.05)


def test_every_element_has_a_finding_that_it_treats():
    proposed_pads = {pad.kind for finding in FINDINGS for pad in finding.pads}
    assert {pad.kind for pad in load_pads()} - proposed_pads == set()
    proposed_types = {c.type for finding in FINDINGS for c in finding.corrections}
    # A pad has its kind, a cup is the depth of the rim, and a stroke is drawn by hand.
    others = {"pelott", "heel_cup", "brush"}
    assert CORRECTION_TYPES.keys() - others - proposed_types == set()
    assert any(finding.cup_mm for finding in FINDINGS)


def test_tibialis_posterior_sets_cup_flange_and_fill(left_foot):
    design = eva(Side.LEFT)
    made = proposed("Tibialis posterior dysfunction, flexible", design, left_foot)
    assert lines(design, made) == [
        "Outline, Width: from the foot → 3.2 mm from the bisection of the 1st metatarsal",
        "Heel cup: 12 mm → 20 mm",
        "Medial flange: 16 mm → 22 mm",
        "Arch fill: 0 mm → 3.2 mm",
    ]
    assert made.finish is not None
    assert (cup_depth_mm(made.finish), medial_flange_mm(made.finish)) == (20, 22)


def test_lateral_instability_adds_skive_posting_and_post(right_foot):
    design = eva(Side.RIGHT)
    told = lines(design, proposed("lateral instability", design, right_foot))
    assert told[0] == "Heel cup: 12 mm → 16 mm"
    assert "Rearfoot post: none → 0°, edge 4 mm" in told
    assert told[-2:] == [
        "Added: heel skive, lateral, 2.5 mm",
        "Added: posting, 0° at the rearfoot, 3° lateral at the forefoot",
    ]


def test_a_finding_may_bring_its_device(left_foot):
    made = proposed("flatfoot of a child", InsoleDesign(Side.LEFT), left_foot)
    assert made.device == "UCBL, child"
    assert made.finish is not None
    assert cup_depth_mm(made.finish) == 20


def test_a_rim_on_a_design_as_scanned_starts_with_the_clinics_device(left_foot):
    plain = InsoleDesign(Side.LEFT)
    assert proposed("Cavus foot", plain, left_foot).device == DEFAULT_DEVICE
    assert proposed("Metatarsalgia", plain, left_foot).finish is None


def test_cup_and_fill_are_set_though_the_clinics_device_has_no_rim(left_foot):
    finding = find_finding(FINDINGS, "Cavus foot")
    catalogue = replace(CATALOGUE, default_device=AS_SCANNED)
    finding = replace(finding, cup_mm=14.0)
    made = apply_finding(finding, InsoleDesign(Side.LEFT), find_landmarks(left_foot), catalogue)
    assert made.device == AS_SCANNED
    assert made.finish is not None
    assert (made.finish.arch_fill_mm, cup_depth_mm(made.finish)) == (finding.arch_fill_mm, 14.0)


def test_what_the_patient_has_stays(left_foot):
    own = (
        Posting(id="p", rearfoot_deg=5, blend_end=0.6),
        HeelSkive(id="m", border="medial", depth_mm=4),
    )
    design = replace(eva(Side.LEFT), corrections=own)
    made = proposed("Lateral instability", design, left_foot)
    posting, medial, lateral = made.corrections
    assert posting == replace(own[0], forefoot_deg=-3)
    assert medial == own[1]
    assert (lateral.type, lateral.border) == ("heel_skive", "lateral")


def test_a_heel_cup_that_the_patient_has_gets_the_proposed_depth(left_foot):
    """It would overrule the rim, and nothing would change."""
    design = replace(eva(Side.LEFT), corrections=(HeelCup(id="c", depth_mm=16),))
    made = proposed("Tibialis posterior dysfunction, flexible", design, left_foot)
    assert made.corrections == (HeelCup(id="c", depth_mm=20),)
    told = lines(design, made)
    assert "Heel cup: 16 mm → 20 mm" in told
    assert "Changed: heel cup, 16 mm → 20 mm" in told


def test_a_pad_lies_at_its_usual_place(left_foot):
    made = proposed("Morton's neuroma, hammer toes", eva(Side.LEFT), left_foot)
    (pad,) = made.corrections
    (usual,) = (pad for pad in CATALOGUE.pads if (pad.kind, pad.size) == ("pelott", "S"))
    laid = placed_pad(usual.template, usual.place, Side.LEFT, find_landmarks(left_foot), 8.0)
    assert pad == replace(laid, id=pad.id, height_mm=3)


def test_new_corrections_are_stamped(left_foot):
    finding = find_finding(FINDINGS, "Metatarsalgia")
    made = apply_finding(
        finding, eva(Side.LEFT), find_landmarks(left_foot), CATALOGUE,
        lambda correction: replace(correction, author="Dr A"),
    )  # fmt: skip
    assert [c.author for c in made.corrections] == ["Dr A"]


def test_every_skive_that_is_proposed_has_the_cup_it_wants(left_foot):
    least = load_rules().skive_least_cup_mm
    for finding in FINDINGS:
        if any(isinstance(c, HeelSkive) for c in finding.corrections):
            assert finding.cup_mm is not None
            assert finding.cup_mm >= least


@pytest.mark.parametrize(
    ("finding", "sentence"),
    [
        (Finding("Odd", pads=(ProposedPad("clog", "M"),)), 'finding "Odd" proposes the pad clog M'),
        (Finding("Odd", device="Clog"), 'no device "Clog"'),
    ],
)
def test_what_the_clinic_does_not_have_is_refused(left_foot, finding, sentence):
    with pytest.raises(InputError, match=sentence):
        apply_finding(finding, eva(Side.LEFT), find_landmarks(left_foot), CATALOGUE)


def test_a_finding_that_there_is_not():
    with pytest.raises(InputError, match=r'no finding "cold feet"; choose one of .*cavus-foot'):
        find_finding(FINDINGS, "cold feet")


def written(folder: Path, *findings: Any) -> ClinicFindings:
    content = {"format": "insole-findings", "version": 1, "findings": findings}
    (folder / "findings.json").write_text(json.dumps(content), "utf-8")
    return ClinicFindings(folder)


def test_a_file_of_findings_that_leads_nowhere_is_told(tmp_path: Path):
    path = tmp_path / "findings.json"
    path.symlink_to(path)
    listed = ClinicFindings(tmp_path).load()
    assert len(listed.items) == len(FINDINGS), "those of the product are there all the same"
    assert "findings.json" in str(*listed.unreadable)


def test_the_clinics_findings_replace_and_add(tmp_path: Path):
    own = written(
        tmp_path,
        {"name": "cavus foot", "cup_mm": 15},
        {"name": "Cold feet", "advice": "Wool."},
    )
    listed = own.load()
    assert len(listed.items) == len(FINDINGS) + 1
    assert listed.own == {"cavus-foot", "cold-feet"}
    assert listed.items["cavus-foot"] == Finding("cavus foot", cup_mm=15)
    assert listed.items["cold-feet"].advice == "Wool."


def unsigned(finding: Finding) -> Finding:
    corrections = tuple(replace(c, id="") for c in finding.corrections)
    return replace(finding, corrections=corrections)


def test_findings_are_written_as_they_are_read(tmp_path: Path):
    path = tmp_path / "shared.json"
    export_findings(FINDINGS, path)
    assert list(map(unsigned, read_findings(path))) == list(map(unsigned, FINDINGS))


def test_a_finding_is_stored_renamed_and_removed(tmp_path: Path):
    clinic = ClinicFindings(tmp_path)
    clinic.save([Finding("Cold feet"), Finding("Cavus foot", cup_mm=15)])
    clinic.save([Finding("Warm feet")], instead_of="Cold feet")
    assert clinic.load().own == {"cavus-foot", "warm-feet"}
    clinic.remove("cavus foot")
    assert unsigned(clinic.load().items["cavus-foot"]) == unsigned(
        find_finding(FINDINGS, "cavus foot")
    )
    kept = clinic.reset()
    assert clinic.load().own == frozenset()
    assert kept is not None
    assert [finding.name for finding in read_findings(kept)] == ["Warm feet"]
    assert clinic.reset() is None


def test_a_broken_file_is_kept_when_findings_are_stored(tmp_path: Path):
    (tmp_path / "findings.json").write_text("half a fi")
    ClinicFindings(tmp_path).save([Finding("Cold feet")])
    assert [f.read_text() for f in tmp_path.glob("*.broken-1")] == ["half a fi"]
    assert ClinicFindings(tmp_path).load().own == {"cold-feet"}


@pytest.mark.parametrize("finding", FINDINGS, ids=lambda finding: finding.name)
def test_what_a_finding_made_of_a_design_is_kept_as_that_finding(finding: Finding, left_foot):
    """On the clinic's device, where the finding changes something of it."""
    marks, before = find_landmarks(left_foot), eva(Side.LEFT)
    made = apply_finding(finding, before, marks, CATALOGUE)
    kept = finding_of(made, "Ours", marks, CATALOGUE)
    assert (kept.left_out, kept.moved) == ((), ())
    again = apply_finding(kept.finding, before, marks, CATALOGUE)
    assert not lines(made, replace(again, corrections=made.corrections))
    assert [main(c) for c in again.corrections] == [main(c) for c in made.corrections]


def main(correction: Any) -> Any:
    return replace(correction, id="", author="", created_at="")


def test_what_is_of_this_foot_alone_is_not_kept(left_foot):
    marks = find_landmarks(left_foot)
    raised = ArchRaise(target_mm=30.0, apex_mm=(20.0, 110.0))
    moved = Pelott(centre_mm=(0.0, 30.0))
    drawn = Pelott(shape="free", centre_mm=(0.0, 30.0), outline_mm=((0, 0), (9, 0), (0, 9)))
    stroke = BrushStroke(points_mm=((0.0, 100.0),))
    design = replace(eva(Side.LEFT), corrections=(raised, moved, drawn, stroke))
    kept = finding_of(design, "Ours", marks, CATALOGUE)
    (arch,) = kept.finding.corrections
    assert arch == replace(raised, id=arch.id, apex_mm=None)
    assert kept.left_out == (drawn, stroke)
    assert kept.moved == (moved,)
    assert [pad.kind for pad in kept.finding.pads] == ["pelott"]


def test_a_kept_finding_needs_a_name(left_foot):
    with pytest.raises(DesignError, match="A name must have"):
        finding_of(eva(Side.LEFT), " ", find_landmarks(left_foot), CATALOGUE)


BAD = [
    ({}, r"findings\[0\].name is missing"),
    ({"name": " , "}, "A name must have"),
    ({"name": "A", "cup": 3}, "cup is no key of a finding"),
    ({"name": "A", "cup_mm": 90}, "cup_mm is 90"),
    ({"name": "A", "corrections": [{"type": "clog"}]}, 'type "clog"'),
    ({"name": "A", "corrections": [{"type": "heel_skive", "depth_mm": 50}]}, "depth_mm.* is 50"),
    ({"name": "A", "posts": [{"region": "toes"}]}, 'region.*"toes"'),
    ({"name": "A", "pads": [{"size": "M"}]}, "kind is missing"),
    ({"name": "A", "pads": [{"kind": "pelott", "size": "M", "height_mm": 99}]}, "height_mm is 99"),
]


@pytest.mark.parametrize(("bad", "sentence"), BAD, ids=[sentence for _, sentence in BAD])
def test_findings_are_read_strictly(tmp_path: Path, bad: dict[str, Any], sentence: str):
    path = tmp_path / "findings.json"
    told = written(tmp_path, bad).load().unreadable
    assert re.search(sentence, str(*told))
    with pytest.raises(InputError, match=sentence) as refused:
        read_findings(path)
    assert str(path) in str(refused.value)
