"""The preview in the window: what it says, and that it lets go."""

from __future__ import annotations

import gc
import weakref
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott, Posting
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import apply_device
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.rim_sliders import with_medial_flange
from insole_core.workflows.clinic_devices import clinic_devices
from insole_studio.app.bootstrap import Application

Settle = Callable[[], None]
SOURCE = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
BESIDE_FOOT = Outline(
    source="drawn", points_mm=((150.0, 0.0), (190.0, 0.0), (190.0, 40.0), (150.0, 40.0))
)


def design(app: Application) -> InsoleDesign:
    assert app.case.record.design is not None
    return app.case.record.design


def test_nothing_derived_from_a_foot_stays_when_its_case_is_closed(
    app: Application, settle: Settle, make_foot: Callable[[Side], Foot]
) -> None:
    foot = replace(make_foot(Side.LEFT))  # the shared one stays for other tests
    app.case.open_foot(foot, SOURCE)
    settle()
    pad = Pelott(centre_mm=(0.0, 150.0))
    for changed in (
        design(app).with_added(pad),
        design(app).with_added(Posting(rearfoot_deg=3.0)),
        replace(design(app), outline=replace(design(app).outline, extent="three_quarter")),
    ):
        app.case.apply(changed, "Change")
        settle()
        assert app.stage.preview.is_current
    gone = weakref.ref(foot)
    del foot
    app.features.case_files.opener.new_case()
    settle()
    gc.collect()
    assert gone() is None
    assert app.stage.preview.mesh is None


def test_a_wish_that_waited_is_built_when_the_one_before_it_cannot_be(
    opened: Application, settle: Settle
) -> None:
    opened.case.preview(replace(design(opened), outline=BESIDE_FOOT))
    opened.case.preview(replace(design(opened), thickness_mm=5.0))  # while that is being built
    settle()
    assert opened.stage.preview.problem == ""
    assert opened.stage.preview.is_current
    contact = opened.stage.preview.contact
    assert contact is not None
    assert contact.heights_mm.min() == 5.0


def test_an_insole_that_is_too_thin_is_shown_and_told(opened: Application, settle: Settle) -> None:
    told: list[str] = []
    opened.stage.preview.failed.connect(told.append)
    recess = Pelott(centre_mm=(0.0, 150.0), height_mm=-4.0)
    opened.case.apply(design(opened).with_added(recess), "Add a recess")
    (sentence,) = told
    assert sentence == opened.stage.preview.problem
    assert sentence.startswith("The insole would be only -1.0 mm thick at x = 0 mm, y = 150 mm;")
    assert opened.stage.preview.is_current
    assert abs(opened.stage.preview.height_mm(0.0, 150.0) + 1.0) < 0.05
    opened.case.undo()
    assert told == [sentence, ""]


def on_device(app: Application, settle: Settle) -> InsoleDesign:
    """Design the shown foot with the product's device, and return the design."""
    devices = clinic_devices(app.services.paths.settings_folder).load().items
    app.case.apply(apply_device(devices["eva-full-length"], design(app)), "Device")
    settle()
    return design(app)


def raised_flange(before: InsoleDesign, height_mm: float) -> InsoleDesign:
    assert before.finish is not None
    return replace(before, finish=with_medial_flange(before.finish, height_mm))


def test_a_dragged_rim_is_followed_at_once_and_built_when_it_is_let_go(
    opened: Application, settle: Settle
) -> None:
    before, preview = on_device(opened, settle), opened.stage.preview
    assert preview.finished is not None
    rim = preview.finished.rim
    peak = rim.edge.point_at(rim.edge.arc_of("medial", 0.45))
    for height_mm in (18.0, 20.0, 22.0):
        low_mm = preview.height_mm(*peak)
        opened.case.preview(raised_flange(before, height_mm))
        assert preview.height_mm(*peak) > low_mm + 1.0, "at once"
        assert not opened.jobs.is_running(), "the processor is left to the hand"
        assert not preview.is_current
        assert preview.finished.rim is rim
    opened.case.apply(raised_flange(before, 22.0), "Raise the flange")
    settle()
    assert preview.is_current
    exact = opened.stage.preview.builder.insole(preview.insole.foot, design(opened))  # type: ignore[union-attr]
    contact = preview.contact
    assert contact is not None
    np.testing.assert_array_equal(contact.heights_mm, exact.contact.heights_mm)


def test_a_rim_that_is_taken_back_is_the_one_before(opened: Application, settle: Settle) -> None:
    before, preview = on_device(opened, settle), opened.stage.preview
    contact = preview.contact
    assert contact is not None
    heights = contact.heights_mm.copy()
    opened.case.preview(raised_flange(before, 22.0))
    opened.case.end_preview()
    assert preview.is_current
    after = preview.contact
    assert after is not None
    np.testing.assert_array_equal(after.heights_mm, heights)
