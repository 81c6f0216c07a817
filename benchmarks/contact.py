"""The contact model against closed forms and published series, and its time under a foot."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks._contact_cases import (
    CONFORMITIES,
    HAYES,
    LAYERED_PADS,
    MATERIALS_MPA,
    PUBLISHED_PADS,
    finite_element_ratios,
    forefoot_pads,
    heel_reliefs,
    punch_stiffness,
    sphere_load_ratio,
)
from benchmarks._random_designs import random_foot
from insole_core.contact.change import Assumptions, Loading, changed, pressure_change
from insole_core.contact.designs import Shoe
from insole_core.contact.elastic_layers import Layer
from insole_core.contact.hardness import foam
from insole_core.contact.load_case import Posture
from insole_core.contact.stance import Ground, Sole
from insole_core.errors import InsoleError
from insole_core.insole.build import build_insole
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import apply_device
from insole_core.insole.prescription.materials import read_materials
from insole_core.workflows.clinic_devices import clinic_devices

CLOSED_FORM_LIMIT, FINITE_ELEMENT_LIMIT = 0.01, 0.05
POINTS_LIMIT, SECONDS_LIMIT = 10.0, 0.1
FEET, DEVICES, FOREFEET = 20, 8, 5
_PUBLISHED = {"flat": -24.0, "full": -44.0}


def _closed_forms() -> None:
    print(f"Flat punch on a layer, against Hayes 1972; limit {CLOSED_FORM_LIMIT:.0%}")
    for poisson, row in HAYES.items():
        for by_thickness, expected in row.items():
            off = punch_stiffness(poisson, by_thickness, nodes=40) / expected - 1
            print(f"  Poisson {poisson:.2f}, radius / thickness {by_thickness:.1f}: {off:+.2%}")
    print(f"Sphere on a layer, against theory; limit {CLOSED_FORM_LIMIT:.0%}")
    for thickness in (30.0, 60.0, 120.0):
        off = sphere_load_ratio(20.0, Layer(thickness, 0.5, 0.3), 5.0, 0.4) - 1
        print(f"  radius 20 mm, thickness {thickness:.0f} mm: {off:+.2%}")


def _finite_elements() -> None:
    print(f"Layered pads, against finite elements; limit {FINITE_ELEMENT_LIMIT:.0%}")
    for name, layers in LAYERED_PADS.items():
        for is_ball in (False, True):
            sinking, peak = finite_element_ratios(layers, is_ball=is_ball)
            kind = "ball, axisymmetric" if is_ball else "cylinder, plane strain"
            print(f"  {name}, {kind}: sinking {sinking - 1:+.2%}, peak {peak - 1:+.2%}")


def _published_heel() -> None:
    print(f"27 insoles under a heel, against Goske 2006; limit {POINTS_LIMIT:.0f} points")
    reliefs = heel_reliefs()
    for form in CONFORMITIES:
        some = [relief for (kind, _, _), relief in reliefs.items() if kind == form]
        published = _PUBLISHED.get(form)
        told = "" if published is None else f"; published {published:+.0f} %"
        print(f"  {form}: {np.mean(some):+.0f} % ({min(some):+.0f} to {max(some):+.0f}){told}")
    for material in MATERIALS_MPA:
        some = [relief for (_, _, name), relief in reliefs.items() if name == material]
        print(f"  {material}: {np.mean(some):+.0f} %")


def _published_forefoot() -> None:
    """Compare pads in walking with Journal of Foot and Ankle Research 7:18, 2014."""
    print("Pads under the forefoot, against Journal of Foot and Ankle Research 7:18")
    found: dict[str, list[tuple[float, bool]]] = {}
    for seed in range(FOREFEET):
        sole = Sole.of(random_foot(seed))
        for name, pad in forefoot_pads(sole).items():
            plain = np.full(sole.known.shape, 4.0)
            grounds = [Ground(plain + mm, plain + mm, foam(20)) for mm in (0.0 * pad, pad)]
            for posture in (Posture.PUSH_OFF, Posture.STANDING):
                told = pressure_change(Loading(sole, 70, posture), *grounds)
                heads = told.regions["metatarsal_heads"]
                case = f"{name}, {posture}"
                found.setdefault(case, []).append((heads.percent or 0.0, not heads.reason))
    for name, some in found.items():
        percents, are_told = zip(*some, strict=True)
        published = PUBLISHED_PADS[name.rpartition(", ")[0]]
        print(f"  {name}: {np.mean(percents):+.0f} %, told for {sum(are_told)} of {len(some)} feet;"
              f" published {published}")  # fmt: skip


def _feet_and_devices() -> None:
    devices = list(clinic_devices(Path()).load().items.values())[:DEVICES]
    shoe = Shoe(read_materials(), body=foam(35))
    seconds, failures, heels = [], [], []
    for seed in range(FEET):
        foot = random_foot(seed)
        sole = Sole.of(foot)
        for device in devices:
            design = replace(apply_device(device, InsoleDesign(foot.side)), grid_mm=2.0)
            try:
                made = build_insole(foot, design)
                start = time.perf_counter()
                ground = shoe.insole(sole, design, made.contact)
                change = changed(Loading(sole, 75), shoe.floor(sole, design), ground, Assumptions())
                seconds.append((time.perf_counter() - start) / 2)
            except InsoleError as error:
                failures.append(f"{device.name}: {error}")
                continue
            heel = change.of("heel").peak_percent
            heels.append(np.nan if heel is None else heel)
    print(f"{FEET} feet × {len(devices)} devices: {len(failures)} failures", *failures, sep="\n  ")
    print(f"  time of one load: median {np.median(seconds):.3f} s, most {max(seconds):.3f} s;"
          f" limit {SECONDS_LIMIT} s")  # fmt: skip
    low, middle, high = np.nanquantile(heels, [0, 0.5, 1])
    print(f"  change at the heel: median {middle:+.0f} % ({low:+.0f} to {high:+.0f})")


def main() -> None:
    for section in (
        _closed_forms,
        _finite_elements,
        _published_heel,
        _published_forefoot,
        _feet_and_devices,
    ):
        section()
