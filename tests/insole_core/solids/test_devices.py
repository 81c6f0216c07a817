"""Every device of the product on an asymmetric foot: as it promises, mirrored, a sound solid."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh

from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.insole.build import Insole, build_insole
from insole_core.insole.elements import Pelott
from insole_core.insole.outline.insole_outline import insole_outline
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import Device, apply_device
from insole_core.insole.prescription.rim_sliders import cup_depth_mm
from insole_core.insole.primitives.outline_curve import inside_curve
from insole_core.insole.surface.contact import contact_base
from insole_core.solids.solid import insole_solid
from insole_core.workflows.clinic_devices import clinic_devices

DEVICES = clinic_devices(Path("/nowhere")).load().items
GRID_MM = 2.0


def insole_of(foot: Foot, device: Device) -> Insole:
    return build_insole(foot, apply_device(device, InsoleDesign(foot.side, grid_mm=GRID_MM)))


@pytest.mark.parametrize("key", DEVICES)
def test_a_device_is_a_sound_solid_on_both_feet(key: str, left_foot, right_foot):
    volumes = []
    for foot in (left_foot, right_foot):
        insole = insole_of(foot, DEVICES[key])
        made = insole_solid(insole)
        solid = trimesh.Trimesh(made.vertices, made.triangles, process=False)
        assert solid.is_watertight
        assert solid.is_winding_consistent
        assert solid.body_count == 1
        assert insole.contact.heights_mm.min() >= insole.design.least_thickness_mm - 1e-9
        volumes.append(solid.volume)
    assert volumes[0] > 10_000
    assert volumes[0] == pytest.approx(volumes[1], rel=1e-3)


@pytest.mark.parametrize("key", DEVICES)
def test_a_device_on_the_mirrored_foot_is_the_mirrored_device(key: str, left_foot, right_foot):
    left, right = (insole_of(foot, DEVICES[key]) for foot in (left_foot, right_foot))
    nodes = left.contact.nodes
    edge = insole_outline(left_foot, left.design, find_landmarks(left_foot))
    nodes = nodes[inside_curve(edge, nodes[:, :2])]
    there = right.contact.height_at(nodes[:, :2] * [-1, 1])
    np.testing.assert_allclose(there, nodes[:, 2], atol=1e-6)


@pytest.mark.parametrize("key", [k for k, d in DEVICES.items() if d.values.finish is not None])
def test_the_cup_is_as_deep_as_the_device_says(key: str, left_foot):
    design = apply_device(DEVICES[key], InsoleDesign(left_foot.side))
    base = contact_base(left_foot, design)
    full = replace(design, outline=replace(design.outline, extent="full"))
    edge = insole_outline(left_foot, full, find_landmarks(left_foot))
    behind = edge[edge[:, 1].argmin()]
    heel = np.array(find_landmarks(left_foot)["heel_centre"].point[:2])
    around = heel + np.stack(np.meshgrid(np.arange(-20, 21), np.arange(-25, 21)), axis=-1)
    floor_mm = base.surface.height_at(around).min()
    assert design.finish is not None
    wanted = cup_depth_mm(design.finish)
    assert base.surface.height_at(behind) - floor_mm == pytest.approx(wanted, abs=0.5)


def test_a_pad_stays_whatever_the_device(left_foot):
    pad = Pelott(centre_mm=(0.0, 140.0), height_mm=5.0)
    for device in DEVICES.values():
        plain = apply_device(device, InsoleDesign(left_foot.side, grid_mm=GRID_MM))
        bare, padded = (build_insole(left_foot, d) for d in (plain, plain.with_added(pad)))
        added = padded.contact.heights_mm - bare.contact.heights_mm
        assert added.max() == pytest.approx(5.0, abs=0.05)
        assert added.min() == 0
