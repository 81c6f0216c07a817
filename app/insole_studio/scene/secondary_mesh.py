"""What stands beside the subject of a view, and the names that tell the two apart."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from pyvista import Color

from insole_core.geometry.mesh import TriangleMesh
from insole_studio.scene.name_label import NameLabel
from insole_studio.scene.painter import MATERIAL, polydata

NAME_PX, FRAME_PX = 15, 4


class SecondaryMesh:
    """Paints on the plotter of a view; what it shows cannot be touched."""

    def __init__(self, plotter: Any, pixel_ratio: float = 1.0) -> None:
        self._plotter = plotter
        self._ratio = pixel_ratio
        self._named = 0

    def show(self, mesh: TriangleMesh | None) -> None:
        """Show a surface in its own colours, or in the material; None for nothing."""
        self._plotter.remove_actor("companion", render=False)
        if mesh is None:
            return
        look: dict[str, Any] = {"color": MATERIAL, "ambient": 0.15, "diffuse": 0.85}
        if mesh.colors is not None:
            look = {"scalars": "colors", "rgb": True, "ambient": 0.55, "diffuse": 0.5}
        self._plotter.add_mesh(
            polydata(mesh), name="companion", render=False, reset_camera=False, specular=0.0, **look
        )

    def clear(self) -> None:
        """Show nothing at all."""
        self.show(None)
        self.show_names(())

    def show_names(self, names: Sequence[NameLabel]) -> None:
        """Write these names and no others."""
        for number in range(self._named):
            self._plotter.remove_actor(_key(number), render=False)
        self._named = len(names)
        for number, name in enumerate(names):
            self._write(_key(number), name)

    def _write(self, key: str, name: NameLabel) -> None:
        actor = self._plotter.add_point_labels(
            np.array([name.place_mm], dtype=float),
            [f" {name.text} "],
            name=key,
            font_size=round(NAME_PX * self._ratio * 72 / self._plotter.render_window.GetDPI()),
            bold=True,
            text_color="white",
            shape=None,
            show_points=False,
            always_visible=True,
            reset_camera=False,
            render=False,
            justification_horizontal="center",
            justification_vertical="center",
        )
        # The ground belongs to the text: the renderer's own shapes stand beside a centred one.
        style = actor.mapper.GetInputAlgorithm().GetTextProperty()
        ground = Color(name.color).float_rgb
        style.SetBackgroundColor(*ground)
        style.SetBackgroundOpacity(1.0)
        # Wide enough for the dots of Ä and Ö, which the ground alone leaves out.
        style.SetFrame(True)
        style.SetFrameColor(*ground)
        style.SetFrameWidth(round(FRAME_PX * self._ratio))


def _key(number: int) -> str:
    """Name an actor unlike those of the other names on the plotter (`name_tags`)."""
    return f"companion-name-{number}"
