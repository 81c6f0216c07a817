"""The tools, in the order of the toolbar."""

from __future__ import annotations

from collections.abc import Sequence

from insole_core.insole.clinic_rules import ClinicRules
from insole_core.workflows.pad_library import LibraryPad, default_pelott
from insole_studio.document.plantar_view import PlantarView
from insole_studio.document.rim_model import RimModel
from insole_studio.document.section_plane import SectionModel
from insole_studio.features.design.tools.brush_tool import BrushTool
from insole_studio.features.design.tools.free_hand_tool import FreeHandTool
from insole_studio.features.design.tools.key_point_tool import KeyPointTool
from insole_studio.features.design.tools.orbit_tool import OrbitTool
from insole_studio.features.design.tools.outline_tool import OutlineTool
from insole_studio.features.design.tools.pelott_tool import PelottTool
from insole_studio.features.design.tools.plane_tool import PlaneTool
from insole_studio.features.design.tools.plantar_tool import PlantarTool
from insole_studio.features.design.tools.posting_tool import PostingTool
from insole_studio.features.design.tools.rim_tool import RimTool
from insole_studio.features.design.tools.section_tool import SectionTool
from insole_studio.features.design.tools.tape_tool import TapeTool
from insole_studio.features.design.tools.tool import Tool
from insole_studio.features.design.tools.turn_tool import TurnTool


def make_tools(
    section: SectionModel,
    rim: RimModel,
    plantar: PlantarView,
    pads: Sequence[LibraryPad],
    rules: ClinicRules,
) -> tuple[Tool, ...]:
    """Construct one instance of every tool.

    Parameters
    ----------
    section
        Plane of the section tool.
    rim
        Rim that its tool shapes.
    plantar
        Pressure map and footprint that their tool lays.
    pads
        Library of the clinic.
    rules
        Of the clinic: the usual distance of a pelott behind the metatarsal heads.
    """
    behind_heads_mm = rules.pelott_usual_behind_heads_mm
    return (
        OrbitTool(behind_heads_mm),
        KeyPointTool(),
        TurnTool(),
        PelottTool(default_pelott(pads), behind_heads_mm),
        FreeHandTool(behind_heads_mm),
        PostingTool(),
        OutlineTool(),
        RimTool(rim),
        BrushTool(),
        PlaneTool(),
        SectionTool(section),
        PlantarTool(plantar),
        TapeTool(),
    )
