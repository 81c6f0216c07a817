"""Random designs on random simulated feet, for benchmarks and tests of solids."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.geometry.side import Side
from insole_core.insole.build import Insole, build_insole
from insole_core.insole.elements import ArchRaise, Correction, HeelCup, HeelSkive, Pelott, Posting
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.finish import Finish, RimStation
from insole_core.insole.prescription.layers import Layers
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Post, Shell
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import vary_shape
from insole_core.solids.solid import KINDS, Kind, SolidOptions

DESIGNS_PER_FOOT = 5


def random_foot(seed: int) -> Foot:
    rng = np.random.default_rng(seed)
    side = Side.LEFT if rng.random() < 0.5 else Side.RIGHT
    mesh = build_foot(vary_shape(rng, side), rng, cell_mm=3.0).mesh
    return place_foot(mesh, side, frame="reference", force=True)


def random_design(foot: Foot, rng: np.random.Generator) -> InsoleDesign:
    pad = Pelott(
        centre_mm=(float(rng.uniform(-20, 20)), float(rng.uniform(0.5, 0.75) * foot.length_mm)),
        length_mm=float(rng.uniform(30, 80)),
        width_mm=float(rng.uniform(20, 60)),
        height_mm=float(rng.uniform(-1.5, 10)),
        turn_deg=float(rng.uniform(-40, 40)),
    )
    posting = Posting(
        rearfoot_deg=float(rng.uniform(-6, 6)), forefoot_deg=float(rng.uniform(-4, 4))
    )
    possible: list[Correction] = [
        pad, posting, HeelSkive(depth_mm=float(rng.uniform(1, 5))),
        ArchRaise(height_mm=float(rng.uniform(1, 6))), HeelCup(depth_mm=float(rng.uniform(8, 20))),
    ]  # fmt: skip
    return InsoleDesign(
        foot.side,
        tuple(c for c in possible if rng.random() < 0.6),
        thickness_mm=float(rng.uniform(2, 8)),
        grid_mm=float(rng.choice([1.0, 1.5, 2.0])),
        max_height_mm=float(rng.uniform(15, 35)),
        bottom=str(rng.choice(["flat", "following"])),
    )


def random_finish(rng: np.random.Generator) -> Finish:
    """Draw a finish between those of a dress insole and of a UCBL."""
    cup, flange, lateral, head, toes = (
        float(rng.uniform(*r)) for r in ((8, 23), (9, 24), (6, 18), (1, 5), (0, 3))
    )
    rim = [
        RimStation(border="medial", along=0.0, height_mm=cup),
        RimStation(border="medial", along=1.0, height_mm=toes, over="toes"),
    ]
    for border, arch in (("medial", flange), ("lateral", lateral)):
        rim += [
            RimStation(border=border, along=0.2, height_mm=cup),
            RimStation(border=border, along=0.45, height_mm=arch),
            RimStation(border=border, along=0.7, height_mm=head, over="toes"),
        ]
    return Finish(
        expansion_mm=float(rng.choice([0.0, 2.0])),
        arch_fill_mm=float(rng.choice([0.0, 1.6, 3.2, 6.4])),
        skin_smoothing_mm=float(rng.uniform(1.5, 3)),
        toe_zone=str(rng.choice(["flat", "flat", "sulcus", "crest", "as_scanned"])),
        toe_line_mm=float(rng.uniform(2, 8)),
        heel_blend_mm=float(rng.uniform(7, 10)),
        arch_blend_mm=float(rng.uniform(9, 13)),
        forefoot_blend_mm=float(rng.uniform(7, 9)),
        rim=tuple(rim),
    )


def random_shell(rng: np.random.Generator) -> Shell:
    """Return a shell of any combination of posts, pitch, taper, edges and walls."""
    posts = tuple(
        Post(
            region=region,
            angle_deg=float(rng.uniform(-6, 6)),
            length_mm=float(rng.choice([15.0, 40.0, 100.0])) if rng.random() < 0.5 else None,
            edge_radius_mm=float(rng.uniform(0, 10)),
        )
        for region in ("rearfoot", "forefoot")
        if rng.random() < 0.5
    )
    return Shell(
        material=str(rng.choice(["polypropylene", "EVA", "PA12, printed"])),
        taper_mm=float(rng.uniform(0.5, 5)),
        taper_length_mm=float(rng.uniform(5, 60)),
        edge_radius_mm=float(rng.choice([0.0, 1.0, 5.0])),
        draft_medial_deg=float(rng.uniform(-15, 30)),
        draft_lateral_deg=float(rng.uniform(-15, 30)),
        chamfer_mm=float(rng.choice([0.0, 0.0, 2.5])),
        heel_pitch_mm=float(rng.choice([0.0, 0.0, 15.0, 30.0])),
        posts=posts,
    )


def random_shell_solids(count: int, seed: int = 0) -> Iterator[Insole]:
    """Yield random insoles with shells, covers and trim lines."""
    rng = np.random.default_rng(seed)
    for number in range(count):
        if number % DESIGNS_PER_FOOT == 0:
            foot = random_foot(1000 + seed + number)
        width = float(rng.choice([-3.2, 0.0, 3.2])) if rng.random() < 0.5 else None
        design = random_design(foot, rng)
        postings = [c for c in design.corrections if isinstance(c, Posting)]
        yield build_insole(
            foot,
            replace(
                design,
                corrections=tuple(c for c in design.corrections if c not in postings),
                grid_mm=float(rng.choice([0.5, 1.0, 2.0])),
                outline=Outline(extent=str(rng.choice(["full", "three_quarter"])), width_mm=width),
                layers=Layers(
                    cover_mm=float(rng.choice([0.0, 2.0, 5.0])),
                    cover_is_taken_off=bool(rng.random() < 0.5),
                ),
                finish=random_finish(rng) if rng.random() < 0.5 else None,
                shell=random_shell(rng),
            ),
        )


def random_solids(count: int, seed: int = 0) -> Iterator[tuple[Insole, Kind, SolidOptions]]:
    """Yield random insoles with the kind and the options of the solid to build from each."""
    rng = np.random.default_rng(seed)
    for number in range(count):
        if number % DESIGNS_PER_FOOT == 0:
            foot = random_foot(seed + number)
        options = SolidOptions(
            draft_deg=float(rng.uniform(-8, 15)), chamfer_mm=float(rng.choice([0.0, 1.0, 2.5]))
        )
        yield build_insole(foot, random_design(foot, rng)), KINDS[number % len(KINDS)], options
