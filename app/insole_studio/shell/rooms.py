"""Everything an action can reach: one room for one duty."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtWidgets import QMainWindow

from insole_studio.shell.appearance import Appearance
from insole_studio.shell.authorship import Authorship
from insole_studio.shell.capture_window import CaptureWindow
from insole_studio.shell.comparing import Comparing
from insole_studio.shell.dialogue import Dialogue
from insole_studio.shell.editing import Editing
from insole_studio.shell.exporting import Exporting
from insole_studio.shell.feet import Feet
from insole_studio.shell.foot_window import FootWindow
from insole_studio.shell.guide import Guide
from insole_studio.shell.measuring import Measuring
from insole_studio.shell.navigating import Navigating
from insole_studio.shell.notices import Notices
from insole_studio.shell.opening import Opening
from insole_studio.shell.prescribing import Prescribing
from insole_studio.shell.repeating import Repeating
from insole_studio.shell.saving import Saving
from insole_studio.shell.stage_window import StageWindow
from insole_studio.shell.variants import Variants
from insole_studio.stages.calibrate.stage import CalibrateStage
from insole_studio.stages.compare.stage import CompareStage
from insole_studio.stages.design.stage import DesignStage


@dataclass(frozen=True, eq=False)
class Rooms:
    """The rooms of the window, and its stages."""

    window: QMainWindow
    stage: DesignStage
    dialogue: Dialogue
    opening: Opening
    saving: Saving
    exporting: Exporting
    editing: Editing
    navigating: Navigating
    prescribing: Prescribing
    measuring: Measuring
    feet: Feet
    variants: Variants
    comparing: Comparing
    repeating: Repeating
    authorship: Authorship
    notices: Notices
    appearance: Appearance
    guide: Guide
    capture: CaptureWindow
    calibrate: StageWindow[CalibrateStage]
    compare: StageWindow[CompareStage]
    foot: FootWindow
