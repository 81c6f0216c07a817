"""The design feature: its stage and its actions."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.insole.clinic_rules import load_rules
from insole_core.workflows.pad_library import load_pads
from insole_studio.document.case import Case
from insole_studio.document.foot_display import FootDisplay
from insole_studio.document.insole_preview import InsolePreview
from insole_studio.document.plantar_view import PlantarView
from insole_studio.document.rim_model import RimModel
from insole_studio.document.section_plane import SectionModel
from insole_studio.document.side_by_side import SideBySide
from insole_studio.features.design.actions.edit_actions import EditActions, KeyboardNavigation
from insole_studio.features.design.actions.feet_actions import FeetActions
from insole_studio.features.design.actions.measure_actions import MeasureActions
from insole_studio.features.design.actions.prescriber_setting import PrescriberSetting
from insole_studio.features.design.actions.prescription_actions import PrescriptionActions
from insole_studio.features.design.actions.repeat_actions import RepeatActions
from insole_studio.features.design.actions.variant_actions import VariantActions
from insole_studio.features.design.actions.view_actions import SideBySideActions
from insole_studio.features.design.devices.device_actions import DeviceActions
from insole_studio.features.design.load.load_actions import LoadActions
from insole_studio.features.design.plantar.plantar_actions import PlantarActions
from insole_studio.features.design.shoe.shoe_actions import ShoeActions
from insole_studio.features.design.stage import DesignStage
from insole_studio.features.design.tools.all_tools import make_tools
from insole_studio.features.design.tools.key_point_tool import KeyPointTool
from insole_studio.features.design.tools.tool_controller import ToolController
from insole_studio.jobs import Jobs
from insole_studio.services.app_services import AppServices


@dataclass(frozen=True, eq=False)
class Design:
    """The stage, and one object for each group of actions."""

    stage: DesignStage
    edit: EditActions
    navigation: KeyboardNavigation
    prescription: PrescriptionActions
    measures: MeasureActions
    feet: FeetActions
    variants: VariantActions
    side_by_side: SideBySideActions
    repeat: RepeatActions
    prescriber: PrescriberSetting
    devices: DeviceActions
    plantar: PlantarActions
    shoe: ShoeActions
    load: LoadActions


def make_design_stage(case: Case, jobs: Jobs, dark: bool) -> DesignStage:
    """Construct the panels and their presenters, before there is a window to hold them.

    Parameters
    ----------
    case
        The open case.
    jobs
        Runs long computations.
    dark
        Whether to use the dark theme.
    """
    section, preview = SectionModel(), InsolePreview(case, jobs)
    rim = RimModel(case, preview)
    pads, rules = load_pads(), load_rules()
    plantar = PlantarView()
    tools = make_tools(section, rim, plantar, pads, rules)
    return DesignStage(
        case=case,
        jobs=jobs,
        surface=preview,
        foot_display=FootDisplay(case, jobs),
        section=section,
        rim=rim,
        plantar=plantar,
        counterpart=SideBySide(case, jobs, preview.builder),
        tool_controller=ToolController(case, tools),
        pads=pads,
        rules=rules,
        dark=dark,
    )


def make_design(services: AppServices, stage: DesignStage) -> Design:
    """Construct the actions on a stage."""
    case, tools = services.case, stage.tool_controller
    feet = FeetActions(case, services.messages)
    measures = MeasureActions(case, services.messages, services.window)
    points = tools.tools[KeyPointTool.key]
    assert isinstance(points, KeyPointTool)
    points.ask_text = measures.ask_text
    shoe = ShoeActions(services)
    stage.ask_size = shoe.ask_size
    edit, side_by_side = EditActions(case, tools), SideBySideActions(case, stage)
    return Design(
        stage=stage,
        edit=edit,
        navigation=KeyboardNavigation(case, stage),
        prescription=PrescriptionActions(
            case,
            tools,
            stage.pads,
            stage.rules.pelott_usual_behind_heads_mm,
            services.messages,
        ),
        measures=measures,
        feet=feet,
        variants=VariantActions(case, services.messages),
        side_by_side=side_by_side,
        repeat=RepeatActions(services, feet),
        prescriber=PrescriberSetting(services),
        devices=DeviceActions(
            services,
            stage.preview,
            stage.pads,
            stage.rules.pelott_usual_behind_heads_mm,
            stage.materials,
        ),
        plantar=PlantarActions(services, stage.plantar, side_by_side, edit),
        shoe=shoe,
        load=LoadActions(services, stage.load, side_by_side, stage.insole),
    )
