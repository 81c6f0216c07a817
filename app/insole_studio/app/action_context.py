"""Everything an action can reach: one room for one duty."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtWidgets import QMainWindow

from insole_studio.app.appearance import Appearance
from insole_studio.app.help_actions import HelpActions
from insole_studio.app.keyboard_navigation import KeyboardNavigation
from insole_studio.features.calibrate.stage import CalibrateStage
from insole_studio.features.capture.capture_window import CaptureWindow
from insole_studio.features.case_files.open_actions import OpenActions
from insole_studio.features.case_files.save_actions import SaveActions
from insole_studio.features.compare.stage import CompareStage
from insole_studio.features.design.actions.edit_actions import EditActions
from insole_studio.features.design.actions.feet_actions import FeetActions
from insole_studio.features.design.actions.measure_actions import MeasureActions
from insole_studio.features.design.actions.prescriber_setting import PrescriberSetting
from insole_studio.features.design.actions.prescription_actions import PrescriptionActions
from insole_studio.features.design.actions.repeat_actions import RepeatActions
from insole_studio.features.design.actions.side_by_side_actions import SideBySideActions
from insole_studio.features.design.actions.variant_actions import VariantActions
from insole_studio.features.design.stage import DesignStage
from insole_studio.features.export.export_actions import ExportActions
from insole_studio.features.foot.foot_window import FootWindow
from insole_studio.services.notices import Notices
from insole_studio.services.stage_window import StageWindow
from insole_studio.services.user_messages import UserMessages


@dataclass(frozen=True, eq=False)
class ActionContext:
    """The rooms of the window, and its stages."""

    window: QMainWindow
    stage: DesignStage
    messages: UserMessages
    opening: OpenActions
    saving: SaveActions
    exporting: ExportActions
    editing: EditActions
    navigating: KeyboardNavigation
    prescribing: PrescriptionActions
    measuring: MeasureActions
    feet: FeetActions
    variants: VariantActions
    comparing: SideBySideActions
    repeating: RepeatActions
    authorship: PrescriberSetting
    notices: Notices
    appearance: Appearance
    guide: HelpActions
    capture: CaptureWindow
    calibrate: StageWindow[CalibrateStage]
    compare: StageWindow[CompareStage]
    foot: FootWindow
