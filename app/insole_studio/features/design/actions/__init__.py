"""Actions of the design feature, and their tables."""

from insole_studio.features.design.actions.edit_actions import EDIT_ACTIONS
from insole_studio.features.design.actions.feet_actions import FEET_ACTIONS
from insole_studio.features.design.actions.prescription_actions import PRESCRIPTION_ACTIONS
from insole_studio.features.design.actions.view_actions import VIEW_ACTIONS

DESIGN_ACTIONS = (*EDIT_ACTIONS, *PRESCRIPTION_ACTIONS, *VIEW_ACTIONS, *FEET_ACTIONS)
