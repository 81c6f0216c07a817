"""A new foot in the window begins with the clinic's device; what there was before stays."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from insole_core.formats.ply import write_ply
from insole_core.geometry.side import Side
from insole_core.insole.clinic_rules import load_rules
from insole_core.insole.elements import Pelott, Posting
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import device_of
from insole_core.insole.prescription.materials import read_materials
from insole_core.insole.warnings.design_warnings import design_warnings
from insole_core.simulate import FootShape, build_foot
from insole_core.workflows.clinic_devices import DefaultDevice, clinic_devices
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_studio.app.bootstrap import Application
from insole_studio.user_paths import UserPaths

pytestmark = pytest.mark.slow
Settle = Callable[[], None]
RIDGE_MM = 0.2
"""Least bend of a ridge between toes over 1 mm."""


@pytest.fixture(scope="module")
def scans(tmp_path_factory: pytest.TempPathFactory) -> dict[Side, list[Path]]:
    """Two scans of the left foot, and one of the right."""
    folder = tmp_path_factory.mktemp("scans")
    paths: dict[Side, list[Path]] = {side: [] for side in Side}
    for number, side in enumerate((Side.LEFT, Side.RIGHT, Side.LEFT)):
        mesh = build_foot(FootShape(side=side), np.random.default_rng(number), cell_mm=5.0).mesh
        paths[side].append(folder / f"{number}-{side}.ply")
        write_ply(mesh, paths[side][-1])
    return paths


def open_scan(app: Application, settle: Settle, path: Path, side: Side) -> InsoleDesign:
    app.features.case_files.opener.open_path(path, side)
    settle()
    design = app.case.record.design
    assert design is not None
    return design


def said(app: Application) -> list[str]:
    return [dialog.text() for dialog in app.services.messages.dialogs]


def test_both_feet_begin_with_the_products_device_and_give_way_untouched_without_a_question(
    app: Application, settle: Settle, scans: dict[Side, list[Path]], questions: Any
) -> None:
    first, second = scans[Side.LEFT]
    left = open_scan(app, settle, first, Side.LEFT)
    right = open_scan(app, settle, scans[Side.RIGHT][0], Side.RIGHT)
    assert (left.side, right.side) == (Side.LEFT, Side.RIGHT)
    for design in (left, right):
        assert design.device == "EVA, full length"
        assert design.finish is not None
        assert design.corrections == ()
    assert replace(left, side=Side.RIGHT) == right
    assert open_scan(app, settle, second, Side.LEFT) == left
    assert questions.asked == []
    assert app.case.record.current is not None
    assert app.case.record.current.source.path == str(second)


def test_a_clinic_begins_with_its_own(
    app: Application, settle: Settle, scans: dict[Side, list[Path]], paths: UserPaths
) -> None:
    ours = device_of(InsoleDesign(Side.LEFT, thickness_mm=6.0), "Ours")
    clinic_devices(paths.settings_folder).save(ours)
    DefaultDevice(paths.settings_folder).save("Ours")
    design = open_scan(app, settle, scans[Side.RIGHT][0], Side.RIGHT)
    assert design == InsoleDesign(Side.RIGHT, thickness_mm=6.0, device="Ours")


def test_a_device_that_is_gone_is_told(
    app: Application, settle: Settle, scans: dict[Side, list[Path]], paths: UserPaths
) -> None:
    DefaultDevice(paths.settings_folder).save("Ours")
    design = open_scan(app, settle, scans[Side.LEFT][0], Side.LEFT)
    assert design.device == "EVA, full length"
    assert any('The clinic\'s device "Ours" is gone' in text for text in said(app))


def test_the_example_is_a_finished_device(app: Application, settle: Settle) -> None:
    """What is seen first is an insole, and no imprint with ridges between the toes."""
    app.features.case_files.opener.open_example()
    settle()
    design, insole = app.case.record.design, app.stage.preview.insole
    assert design is not None
    assert insole is not None
    assert (design.device, design.base) == ("EVA, full length", None)
    assert [type(correction) for correction in design.corrections] == [Pelott, Posting]
    found = design_warnings(insole, landmarks_of(app.case.record), load_rules(), read_materials())
    assert found == ()
    length = insole.foot.length_mm
    x, y = np.meshgrid(np.linspace(-25, 15, 41), np.linspace(0.85, 0.95, 9) * length)
    heights = insole.contact.height_at(np.stack([x.ravel(), y.ravel()], axis=1)).reshape(x.shape)
    assert np.abs(np.diff(heights, 2, axis=1)).max() < RIDGE_MM
