"""Actions of the design feature, and their tables."""

from insole_studio.features.design.actions.edit_records import EDIT_ACTIONS
from insole_studio.features.design.actions.feet_records import FEET_ACTIONS
from insole_studio.features.design.actions.prescription_records import PRESCRIPTION_ACTIONS
from insole_studio.features.design.actions.view_records import VIEW_ACTIONS

DESIGN_ACTIONS = (*EDIT_ACTIONS, *PRESCRIPTION_ACTIONS, *VIEW_ACTIONS, *FEET_ACTIONS)
