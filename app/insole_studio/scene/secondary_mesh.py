"""The mesh beside the subject of a view, and the names that tell the two apart."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from pyvista import Color

from insole_core.geometry.mesh import TriangleMesh
from insole_studio.scene.coloring import Coloring
from insole_studio.scene.guide_lines import NameLabel
from insole_studio.scene.painter import polydata, surface_look

NAME_PX, FRAME_PX = 15, 4


class SecondaryMesh:
    """A second mesh on the plotter of a view; it cannot be picked."""

    def __init__(self, plotter: Any, pixel_ratio: float = 1.0) -> None:
        self._plotter = plotter
        self.pixel_ratio = pixel_ratio
        self._named = 0

    def show(self, mesh: TriangleMesh | None, coloring: Coloring | None = None) -> None:
        """Show a surface, by default in its own or the material's colours; None removes it."""
        self._plotter.remove_actor("companion", render=False)
        if mesh is None:
            return
        surface = polydata(mesh)
        look = surface_look(surface, mesh, coloring)
        self._plotter.add_mesh(
            surface, name="companion", render=False, reset_camera=False, specular=0.0, **look
        )

    def clear(self) -> None:
        """Show nothing at all."""
        self.show(None)
        self.show_names(())

    def show_names(self, names: Sequence[NameLabel]) -> None:
        """Replace the shown names."""
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
            font_size=NAME_PX,
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
        # The text draws its own background: the renderer's shapes do not follow centred text.
        style = actor.mapper.GetInputAlgorithm().GetTextProperty()
        ground = Color(name.color).float_rgb
        style.SetBackgroundColor(*ground)
        style.SetBackgroundOpacity(1.0)
        # Wide enough for the dots of Ä and Ö, which the background alone does not cover.
        style.SetFrame(True)
        style.SetFrameColor(*ground)
        style.SetFrameWidth(round(FRAME_PX * self.pixel_ratio))


def _key(number: int) -> str:
    """Return an actor name distinct from those of `name_tags` on the same plotter."""
    return f"companion-name-{number}"
