"""The form of finished insoles: 200 random designs on random feet, the shared sessions, real feet.

    python -m benchmarks insole_form

Every insole is measured by what is asked of each: see `_insole_form.ASKED`. The mirrored foot must
have the mirrored insole to 1e-6 mm. Limits of time on the grid of 1 mm: rebuild 120 ms; a drag,
pointer event to arrays, of a rim's handle 16 ms, of a slider, the toe line or the share of the
foot 50 ms, of a pad 2 ms, and 10 ms where the underside follows it.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks._insole_form import ASKED, Form, measured_form, missed
from benchmarks._measure import print_table
from benchmarks._random_designs import random_design, random_finish, random_foot
from insole_core.errors import InsoleError
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.base_form import BaseForm
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import apply_device
from insole_core.insole.prescription.rim_sliders import with_cup_depth
from insole_core.insole.prescription.template import mirrored
from insole_core.workflows.clinic_devices import clinic_devices, clinic_forms, find_device
from insole_core.workflows.edited_insole import EditedInsole
from insole_core.workflows.insole_builder import InsoleBuilder
from insole_core.workflows.open_scan import open_scan

DESIGNS, DESIGNS_PER_FOOT, DESIGNS_PER_SCAN = 200, 5, 10
SHARED = Path(__file__).resolve().parents[2] / "shared" / "data"
SCANS: tuple[tuple[str, Side | None], ...] = (
    ("sessions/left_a", None), ("sessions/right_b", None), ("sessions/left_c", None),
    ("sessions/right_d", None), ("feet/dupontgu/left_foot.stl", Side.LEFT),
    ("feet/dupontgu/right_foot.stl", Side.RIGHT), ("feet/plantar_scan.obj", Side.RIGHT),
    ("feet/focus_template/template.obj", Side.LEFT),
    ("feet/foot3d_0044/mesh.obj", Side.RIGHT), ("feet/foot3d_0044/colmap_mesh.obj", Side.RIGHT),
)  # fmt: skip
DRAGS, REBUILDS = 200, 30
DEVICES = "EVA, full length", "Functional, three-quarter", "Sport, full length"
ARCH = 0.45  # where `random_finish` has its stations


def designed(foot: Foot, rng: np.random.Generator) -> InsoleDesign:
    """Draw a design with a finish, on the grid of 1 mm."""
    return replace(random_design(foot, rng), finish=random_finish(rng), grid_mm=1.0)


def random_forms() -> Iterator[tuple[str, Form]]:
    for number in range(DESIGNS):
        if number % DESIGNS_PER_FOOT == 0:
            foot = random_foot(number)
        yield "random feet", measured_form(foot, designed(foot, np.random.default_rng(number)))


def scans() -> Iterator[tuple[str, Foot]]:
    for name, side in SCANS:
        if not (SHARED / name).exists():
            print(f"{name} is absent")
            continue
        try:
            yield name, open_scan(SHARED / name, side).foot
        except InsoleError as error:
            print(f"{name}: {error}")


def scanned_forms(feet: list[tuple[str, Foot]]) -> Iterator[tuple[str, Form]]:
    for name, foot in feet:
        for number in range(DESIGNS_PER_SCAN):
            design = designed(foot, np.random.default_rng(1000 + number))
            yield name, measured_form(foot, design)


def print_forms(forms: list[tuple[str, Form]]) -> None:
    names = list(dict.fromkeys(name for name, _ in forms))
    worst = {"support_share": min}
    rows = []
    for key in (f.name for f in fields(Form)):
        pick = worst.get(key, max)
        found = [pick(getattr(f, key) for n, f in forms if n == name) for name in names]
        rows.append((key, f"{ASKED[key]:g}", *(f"{value:.3g}" for value in found)))
    print_table(("worst of", "asked", *names), rows)
    fails = Counter(key for _, form in forms for key in missed(form))
    sound = sum(not missed(form) for _, form in forms)
    print(f"{sound} of {len(forms)} insoles are all that is asked; missed: {dict(fails)}")


def mirror_image(foot: Foot) -> Foot:
    mirror = np.diag([-1.0, 1, 1, 1])
    pose = mirror @ foot.source2insole @ mirror
    return replace(foot, side=foot.side.other, mesh=foot.mesh.mirrored(), source2insole=pose)


def mirror_error_mm(foot: Foot, design: InsoleDesign) -> float:
    """Compare an insole with that of the mirrored foot, both by the surface alone."""
    foot = replace(foot, mesh=replace(foot.mesh, touches=None))  # contours are not mirrored here
    own = build_insole(foot, design).contact
    other = build_insole(mirror_image(foot), mirrored(design)).contact
    return float(np.abs(own.heights_mm - other.heights_mm[:, ::-1]).max())


def times_ms(call: Callable[[int], object], count: int) -> tuple[str, str]:
    times = []
    for i in range(count):
        start = time.process_time()  # of this process: others may run
        call(i)
        times.append(1000 * (time.process_time() - start))
    return f"{np.median(times):.1f}", f"{np.quantile(times, 0.99):.1f}"


def dragged(design: InsoleDesign, i: int) -> InsoleDesign:
    """Drag the stations of the arch up and down, to a new height at each step."""
    assert design.finish is not None
    rim = [
        replace(s, height_mm=s.height_mm + 0.013 * i) if s.along == ARCH else s
        for s in design.finish.rim
    ]
    return replace(design, finish=replace(design.finish, rim=tuple(rim)))


def with_finish(design: InsoleDesign, **values: Any) -> InsoleDesign:
    assert design.finish is not None
    return replace(design, finish=replace(design.finish, **values))


def with_cup(design: InsoleDesign, depth_mm: float) -> InsoleDesign:
    assert design.finish is not None
    return replace(design, finish=with_cup_depth(design.finish, depth_mm))


def with_share(design: InsoleDesign, share: float) -> InsoleDesign:
    assert design.base is not None
    return replace(design, base=replace(design.base, contact_share=share))


def print_times(foot: Foot) -> None:
    design = designed(foot, np.random.default_rng(3))
    builder = InsoleBuilder()
    edited = EditedInsole(builder.bare(foot, design), design)
    insoles = times_ms(lambda i: builder.insole(foot, dragged(design, i + 1)), REBUILDS)
    solids = times_ms(lambda i: builder.bare(foot, dragged(design, -i - 1)), REBUILDS)
    drags = times_ms(lambda i: edited.follow(dragged(design, i % 50)), DRAGS)
    rows = [
        ("rebuild of the insole", *insoles, "120"),
        ("rebuild with its solid", *solids, "120"),
        ("drag of a rim's handle", *drags, "16"),
        *(row for name in DEVICES for row in device_rows(foot, name)),
    ]
    print_table(("edit, grid of 1 mm", "median CPU ms", "99 % CPU ms", "limit"), rows)


def device_rows(foot: Foot, name: str) -> list[tuple[str, str, str, str]]:
    """Time the edits of a device with a pad and a base form: what a drag does in each step."""
    device = find_device(clinic_devices(Path("none")).load().items, name)
    form = next(iter(clinic_forms(Path("none")).load().items.values()))
    pad = Pelott(centre_mm=(5.0, 0.6 * foot.length_mm), height_mm=4.0)
    plain = apply_device(device, InsoleDesign(foot.side, (pad,)))
    start = replace(plain, base=BaseForm(form=form, contact_share=0.7))
    edits: tuple[tuple[str, str, Callable[[int], InsoleDesign]], ...] = (
        (
            "pad",
            "2" if start.bottom == "flat" else "10",
            lambda i: start.with_changed(replace(pad, turn_deg=0.1 * i)),
        ),
        ("cup", "50", lambda i: with_cup(start, 12 + 0.05 * (i % 90))),
        ("fill", "50", lambda i: with_finish(start, arch_fill_mm=0.05 * i)),
        ("toe line", "50", lambda i: with_finish(start, toe_line_mm=3 + 0.1 * i)),
        ("share of the foot", "50", lambda i: with_share(start, 0.7 + 0.001 * i)),
    )
    rows = []
    for what, limit, edit in edits:
        builder = InsoleBuilder()
        edited = EditedInsole(builder.bare(foot, start), start)
        times = times_ms(lambda i, to=edit, on=edited: on.follow(to(i)), DRAGS)  # type: ignore[misc]
        rows.append((f"{name}: drag of {what}", *times, limit))
    rebuilt = times_ms(lambda i: InsoleBuilder().bare(foot, edits[2][2](i)), REBUILDS)
    return [*rows, (f"{name}: rebuild with its solid", *rebuilt, "120")]


def main() -> None:
    feet = list(scans())
    print_forms([*random_forms(), *scanned_forms(feet)])
    pairs = [(random_foot(seed), np.random.default_rng(seed)) for seed in range(5)]
    pairs += [(foot, np.random.default_rng(9)) for _, foot in feet]
    worst = max(mirror_error_mm(foot, designed(foot, rng)) for foot, rng in pairs)
    print(f"mirrored foot against mirrored insole: {worst:.1e} mm (limit 1e-6)")
    print_times(random_foot(3))


if __name__ == "__main__":
    main()
