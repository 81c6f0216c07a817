"""Draw the devices of the product on one foot, each from four sides."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyvista as pv
from PIL import Image, ImageDraw, ImageFont

from insole_core.foot.foot import Foot
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import apply_device, read_device
from insole_core.messages import Translate
from insole_core.resources import resource_path
from insole_core.workflows.insole_builder import InsoleBuilder

SHOWN = (
    "functional-three-quarter", "dress-three-quarter", "sport-full-length", "ucbl-child",
    "eva-full-length", "diabetic-full-length",
)  # fmt: skip
SIDES = {
    "above": ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0)),
    "below": ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0)),
    "medial": ((1.0, -0.35, 0.35), (0.0, 0.0, 1.0)),
    "behind": ((0.15, -1.0, 0.3), (0.0, 0.0, 1.0)),
}
"""Where the camera stands, and what is up; medial for a foot whose medial side is at +x."""
CELL_PX = (300, 300)
LABEL_PX = 22
MATERIAL = "#d9cbb0"


def draw_devices(foot: Foot, path: Path, translate: Translate) -> None:
    """Write one picture of all devices: a row each, from above, below, medial and behind.

    Parameters
    ----------
    foot
        The insoles are made for it with nothing but the device.
    translate
        The names of the devices into the language of the picture.
    """
    width, height = CELL_PX
    sheet = Image.new("RGB", (len(SIDES) * width, len(SHOWN) * (height + LABEL_PX)), "white")
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(14)
    for row, key in enumerate(SHOWN):
        device = read_device(resource_path(f"devices/{key}.json"))
        design = apply_device(device, InsoleDesign(foot.side))
        _, solid = InsoleBuilder().solid(foot, design)
        top = row * (height + LABEL_PX)
        pen.text((8, top + 3), translate(device.name), fill="black", font=font)
        for column, side in enumerate(SIDES):
            picture = _seen_from(solid, side, foot.side.medial_sign)
            sheet.paste(picture, (column * width, top + LABEL_PX))
    sheet.save(path)


def _seen_from(solid: TriangleMesh, side: str, medial_sign: int) -> Image.Image:
    towards, up = (np.array(vector) for vector in SIDES[side])
    towards = towards * [medial_sign, 1, 1]
    plotter = pv.Plotter(off_screen=True, window_size=list(CELL_PX))
    plotter.background_color = "white"
    body = pv.make_tri_mesh(solid.vertices, solid.triangles)
    plotter.add_mesh(body, color=MATERIAL, smooth_shading=True, split_sharp_edges=True)
    middle = np.array(body.center)
    plotter.camera_position = [tuple(middle + 600 * towards), tuple(middle), tuple(up)]
    plotter.enable_parallel_projection()
    plotter.reset_camera()
    picture = Image.fromarray(np.asarray(plotter.screenshot(return_img=True)))
    plotter.close()
    return picture
