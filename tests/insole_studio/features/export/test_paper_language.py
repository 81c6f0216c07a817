"""The papers of a Swedish clinic hold no English words."""

from __future__ import annotations

import re
from collections.abc import Callable
from datetime import date, timedelta
from pathlib import Path
from typing import Any

import manifold3d
import pytest
from PySide6.QtWidgets import QApplication
from read_pdf import text_of_pdf

from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.compare.comparison import ComparisonSource
from insole_core.export.shop_order import OrderTerms
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import (
    ArchRaise,
    BrushStroke,
    ForefootTwist,
    HeelCup,
    HeelLift,
    HeelSkive,
    Pelott,
    Posting,
    Rocker,
)
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import apply_device, read_device
from insole_core.insole.prescription.layers import Layers
from insole_core.messages import Message
from insole_core.milling.machine import read_machine
from insole_core.milling.plan import MillingPlan, plan_milling
from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_core.records.signing import sign
from insole_core.records.statement import statement_of, write_statement_paper
from insole_core.records.visit import Visit
from insole_core.resources import resource_path
from insole_core.solids.export_rules import read_rules
from insole_core.solids.prescription_paper import Responsible
from insole_core.solids.shop import Block, read_shop
from insole_core.solids.simplification import from_manifold
from insole_core.workflows import nest_orders
from insole_core.workflows.compare_case import compare_sources, write_comparison
from insole_core.workflows.make_order import OrderChoice, make_parts, write_order
from insole_core.workflows.mill import MillingChoice
from insole_core.workflows.nest_orders import OrderedPiece, nest_pieces, write_nest
from insole_core.workflows.records.export_person import export_person
from insole_core.workflows.records.person_summary import Wording
from insole_studio.texts import translation_into

SHOP = read_shop()
PAIR = next(block for block in SHOP.blocks if block.name == "EVA pair")
NOWHERE = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
CORRECTIONS = (
    Pelott(centre_mm=(0.0, 185.0)),
    Pelott(centre_mm=(0.0, 20.0), shape="cut_out", kind="heel_spur_recess", height_mm=-2.0),
    Pelott(centre_mm=(-12.0, 150.0), shape="bar"),
    Posting(rearfoot_deg=3.0, forefoot_deg=-2.0),
    ForefootTwist(angle_deg=2.0),
    HeelSkive(),
    HeelLift(),
    ArchRaise(),
    HeelCup(),
    Rocker(),
    BrushStroke(points_mm=((0.0, 100.0), (9.0, 120.0))),
)
ALIKE = {
    "block", "export", "full", "inversion", "lateral", "material", "medial", "patient", "pelott",
    "pseudonym", "revision", "xiii",
    "eva", "insole", "pair", "sha", "stl", "studio",
}  # fmt: skip
"""Words that are the same in both languages, and names: of the program, a block, a format."""
OF_MACHINES = {
    "linuxcnc", "flat", "end", "nose", "pin", "holes", "setup", "sheet", "program", "diameter",
    "shore", "dxf", "pdf", "ball", "min",
}  # fmt: skip
"""Names of files, and of the machine and its cutters, which the shop writes; and the same words."""


def words_of(path: Path) -> set[str]:
    found = set(re.findall(r"[a-zåäö]{3,}", text_of_pdf(path).lower()))
    return {word for word in found if set(word) - set("abcdef")}  # but parts of a digest


def test_papers_in_swedish_hold_no_word_of_the_english_ones(
    qapp: QApplication, make_foot: Callable[[Side], Foot], tmp_path: Path
) -> None:
    device = read_device(resource_path("devices/functional-three-quarter.json"))
    feet = tuple(
        FootRecord.begun(
            make_foot(side),
            NOWHERE,
            apply_device(
                device, InsoleDesign(side, CORRECTIONS, grid_mm=2.0, layers=Layers(cover_mm=2.0))
            ),
        )
        for side in Side
    )
    patient = Patient("Ö", "1970-02-28", "2026-11-20")
    record = CaseRecord(patient, feet, Side.LEFT)
    terms = OrderTerms(2, "", "", "", date.today() + timedelta(days=9))
    choice = OrderChoice(
        both=True, block=PAIR, prescription=True, pseudonym="26-7KQ4M", terms=terms,
        material="EVA",
    )  # fmt: skip
    parts = make_parts(record, choice, read_rules())
    for language in ("en", "sv"):
        (tmp_path / language).mkdir()
        write_order(
            parts, choice, tmp_path / language / "o.stl",
            shop=SHOP, patient=patient, responsible=Responsible("Ö", "Ö", "Ö", "Ö"),
            translate=translation_into(language),
        )  # fmt: skip
    for paper, count in (("o-pair-job-sheet.pdf", 150), ("o-pair-prescription.pdf", 150)):
        english, swedish = words_of(tmp_path / "en" / paper), words_of(tmp_path / "sv" / paper)
        assert len(english - swedish) > count
        assert english & swedish - ALIKE == set()


def test_papers_of_the_router_in_swedish_hold_no_word_of_the_english_ones(
    qapp: QApplication, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The sheet of a nest, and the set-up sheet of a block that is turned."""
    plans: list[MillingPlan] = []

    def plan_once(*given: Any, **named: Any) -> MillingPlan:
        if not plans:  # the paths are the same in each language
            plans.append(plan_milling(*given, **named))
        return plans[0]

    monkeypatch.setattr(nest_orders, "plan_milling", plan_once)
    corners = [(0, 0), (40, 0), (40, 50), (20, 70), (0, 60)]
    solid = from_manifold(manifold3d.CrossSection([corners]).extrude(9.0))
    pieces = [OrderedPiece("26-7", side, solid, "EVA, Shore A 35") for side in Side]
    board = Block("EVA pair, low", (180.0, 160.0, 12.0))
    nest = nest_pieces(pieces, board, margin_mm=30, across=False)
    machine = read_machine(resource_path("milling/linuxcnc.json"))
    for language in ("en", "sv"):
        (tmp_path / language).mkdir()
        write_nest(
            nest, tmp_path / language / "o.stl", title="26-7",
            milling=MillingChoice(machine, both_sides=True), translate=translation_into(language),
        )  # fmt: skip
        assert "o-pin-holes" in text_of_pdf(tmp_path / language / "o-pieces.pdf")
    for paper, count in (("o-pieces.pdf", 20), ("o-setup-sheet.pdf", 50)):
        english, swedish = words_of(tmp_path / "en" / paper), words_of(tmp_path / "sv" / paper)
        assert len(english - swedish) > count
        assert english & swedish - ALIKE - OF_MACHINES == set()


def test_a_comparison_in_swedish_holds_no_word_of_the_english_one(
    qapp: QApplication, make_foot: Callable[[Side], Foot], tmp_path: Path
) -> None:
    one, other = make_foot(Side.LEFT).mesh, make_foot(Side.RIGHT).mesh
    for language in ("en", "sv"):
        translate = translation_into(language)
        sources = (
            ComparisonSource(Message("left foot"), one, side=Side.LEFT),
            ComparisonSource(Message("right foot"), other, side=Side.RIGHT),
        )
        a, b = sources[0], sources[1].like(sources[0])
        compared = compare_sources(a, b, "none", 1)
        paper = tmp_path / f"{language}.pdf"
        write_comparison(compared, (a.name, b.name), paper, translate)
    english, swedish = words_of(tmp_path / "en.pdf"), words_of(tmp_path / "sv.pdf")
    assert len(english - swedish) > 15
    assert english & swedish - ALIKE - {"median", "minus"} == set()


def test_papers_of_the_record_in_swedish_hold_no_word_of_the_english_ones(
    records: Records, make_foot: Callable[[Side], Foot], tmp_path: Path
) -> None:
    """The statement of Annex XIII, and the summary of a person that leaves the record."""
    person = records.persons.add(Person("Ö", date(1970, 2, 28), contact="Ö", notes="Ö"))
    visit = records.visits.add(Visit(person.id, date.today(), reason="Ö", findings="Ö"))
    design = InsoleDesign(Side.LEFT, CORRECTIONS, grid_mm=2.0)
    foot = FootRecord.begun(make_foot(Side.LEFT), NOWHERE, design)
    kept = records.prescriptions.save(visit.id, foot, None)
    order = records.orders.add(visit.id, [kept.version_id], number="26-7KQ4M")
    with records.context.database.writing() as connection:
        sign(connection, kept.version_id, records.who)
    made = Responsible(maker="Ö", maker_address="Ö")
    for language in ("en", "sv"):
        folder, translate = tmp_path / language, translation_into(language)
        statement = statement_of(records.context, order.id, made)
        made_of = export_person(records, person.id, folder, wording=Wording(language, translate))
        write_statement_paper(statement, folder / "statement.pdf", date.today(), translate)
    alike = ALIKE | {"version", "variant", "utc", "orders", "statement", records.who.name}
    names = " ".join((person.pseudonym, *made_of.files)).lower()  # of folders and files, too
    alike |= set(re.findall(r"[a-z]{3,}", names))
    for paper in ("statement.pdf", "summary.pdf"):
        english, swedish = (words_of(tmp_path / language / paper) for language in ("en", "sv"))
        assert len(english - swedish) > 80
        assert english & swedish - alike == set()
