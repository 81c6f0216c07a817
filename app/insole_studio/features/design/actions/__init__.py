"""What the menus do to a design, and the table of these actions."""

from insole_studio.features.design.actions.edit_records import EDIT_ACTIONS
from insole_studio.features.design.actions.feet_records import FEET_ACTIONS
from insole_studio.features.design.actions.prescription_records import PRESCRIPTION_ACTIONS
from insole_studio.features.design.actions.view_records import VIEW_ACTIONS

DESIGN_ACTIONS = (*EDIT_ACTIONS, *PRESCRIPTION_ACTIONS, *VIEW_ACTIONS, *FEET_ACTIONS)
