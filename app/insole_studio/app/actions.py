"""Every action of the window as a record; menus and toolbar are tables of their keys."""

from __future__ import annotations

from collections.abc import Callable

from insole_core.insole.prescription.design import (
    ArchRaise,
    Correction,
    ForefootTwist,
    HeelCup,
    HeelLift,
    HeelSkive,
    Posting,
)
from insole_studio.app.navigation_action_records import NAVIGATION_ACTIONS
from insole_studio.features.design.actions.feet_action_records import FOOT_ACTIONS
from insole_studio.features.design.models.color_maps import MapKind
from insole_studio.scene.view_camera import Preset
from insole_studio.services.action_record import ActionRecord
from insole_studio.settings import Language
from insole_studio.texts import tr


def _tool(
    key: str,
    text: Callable[[], str],
    tip: Callable[[], str],
    shortcut: str,
    short: Callable[[], str] | None = None,
) -> ActionRecord:
    return ActionRecord(
        f"tool_{key}",
        text,
        tip,
        lambda rooms, on: rooms.editing.take_tool(key) if on else None,
        icon=key,
        shortcut=shortcut,
        checkable=True,
        group="tools",
        needs_foot=True,
        short=short,
    )


def _prescription(
    text: Callable[[], str], tip: Callable[[], str], make: Callable[[], Correction]
) -> ActionRecord:
    return ActionRecord(
        f"add_{make().type}",
        text,
        tip,
        lambda rooms, _on: rooms.prescribing.prescribe(make()),
        needs_foot=True,
    )


def _language(key: Language, text: Callable[[], str]) -> ActionRecord:
    return ActionRecord(
        f"language_{key}",
        text,
        lambda: tr("The language of the window, from the next start on"),
        lambda rooms, on: rooms.appearance.set_language(key) if on else None,
        checkable=True,
        group="languages",
    )


def _map(
    kind: MapKind, text: Callable[[], str], tip: Callable[[], str], shortcut: str
) -> ActionRecord:
    return ActionRecord(
        f"map_{kind.value}",
        text,
        tip,
        lambda rooms, on: rooms.comparing.show_map(kind) if on else None,
        shortcut=shortcut,
        checkable=True,
        group="maps",
        needs_foot=True,
    )


def _preset(preset: Preset, number: int, text: Callable[[], str]) -> ActionRecord:
    return ActionRecord(
        f"look_{preset.value}",
        text,
        lambda: tr("Look from here, in both views"),
        lambda rooms, _on: rooms.stage.look(preset),
        shortcut=str(number),
        needs_foot=True,
    )


ACTIONS: tuple[ActionRecord, ...] = (
    *FOOT_ACTIONS,
    *NAVIGATION_ACTIONS,
    ActionRecord(
        "new_case",
        lambda: tr("New case"),
        lambda: tr("Begin with an empty case"),
        lambda rooms, _on: rooms.opening.new_case(),
        shortcut="Ctrl+N",
    ),
    ActionRecord(
        "capture",
        lambda: tr("Capture…"),
        lambda: tr("Capture a foot with the sensors"),
        lambda rooms, _on: rooms.capture.open(),
        icon="capture",
        shortcut="Ctrl+Shift+C",
    ),
    ActionRecord(
        "open",
        lambda: tr("Open case…"),
        lambda: tr("Open a case that was saved"),
        lambda rooms, _on: rooms.opening.ask_open_case(),
        icon="open",
        shortcut="Ctrl+O",
    ),
    ActionRecord(
        "open_session",
        lambda: tr("Open session…"),
        lambda: tr("Open the folder of a recorded session and reconstruct its foot"),
        lambda rooms, _on: rooms.opening.ask_open_session(),
        icon="session",
        shortcut="Ctrl+Shift+O",
    ),
    ActionRecord(
        "open_archive",
        lambda: tr("Open session archive or mesh…"),
        lambda: tr("Open a session in a zip archive, or a foot from a .ply, .stl or .obj file"),
        lambda rooms, _on: rooms.opening.ask_open_mesh(),
        icon="mesh",
        shortcut="Ctrl+M",
    ),
    ActionRecord(
        "open_example",
        lambda: tr("Open the example"),
        lambda: tr("Open the case that comes with Insole Studio"),
        lambda rooms, _on: rooms.opening.open_example(),
    ),
    ActionRecord(
        "save",
        lambda: tr("Save"),
        lambda: tr("Save the case"),
        lambda rooms, _on: rooms.saving.save(),
        icon="save",
        shortcut="Ctrl+S",
    ),
    ActionRecord(
        "save_as",
        lambda: tr("Save as…"),
        lambda: tr("Save the case under another name"),
        lambda rooms, _on: rooms.saving.ask_save(),
        shortcut="Ctrl+Shift+S",
    ),
    ActionRecord(
        "export",
        lambda: tr("Check & export…").replace("&", "&&"),
        lambda: tr("Check the insole and write it for the shop, with its papers"),
        lambda rooms, _on: rooms.exporting.ask_export(),
        icon="export",
        shortcut="Ctrl+E",
        needs_foot=True,
    ),
    ActionRecord(
        "quit",
        lambda: tr("Quit"),
        lambda: tr("Close Insole Studio"),
        lambda rooms, _on: rooms.window.close(),
        shortcut="Ctrl+Q",
    ),
    ActionRecord(
        "undo",
        lambda: tr("Undo"),
        lambda: tr("Take the last step back"),
        lambda rooms, _on: rooms.editing.undo(),
        icon="undo",
        shortcut="Ctrl+Z",
    ),
    ActionRecord(
        "redo",
        lambda: tr("Redo"),
        lambda: tr("Do the last undone step again"),
        lambda rooms, _on: rooms.editing.redo(),
        icon="redo",
        shortcut="Ctrl+Shift+Z",
    ),
    ActionRecord(
        "remove",
        lambda: tr("Remove correction"),
        lambda: tr("Take the selected correction out of the design"),
        lambda rooms, _on: rooms.editing.remove_selected(),
        icon="remove",
        shortcut="Del",
        needs_foot=True,
    ),
    _tool(
        "orbit",
        lambda: tr("Orbit"),
        lambda: tr("Turn the view; click on a pelott to select it"),
        "O",
    ),
    _tool(
        "key_point", lambda: tr("Landmarks"), lambda: tr("Put right the landmarks of the foot"), "K"
    ),
    _tool(
        "turn",
        lambda: tr("Turn the foot"),
        lambda: tr("Turn the foot by rings; type its angles, or align it by the landmarks"),
        "A",
        lambda: tr("Turn foot"),
    ),
    _tool("pelott", lambda: tr("Pelott"), lambda: tr("Place and shape pelotts"), "P"),
    _tool(
        "free_hand",
        lambda: tr("Free-hand pad"),
        lambda: tr("Draw the outline of a pad on the sole"),
        "D",
        lambda: tr("Free-hand"),
    ),
    _tool(
        "posting",
        lambda: tr("Pronation"),
        lambda: tr("Pronation / supination: tilt rear- and forefoot"),
        "T",
    ),
    _tool(
        "outline",
        lambda: tr("Outline"),
        lambda: tr("Drag the edge of the insole; from the foot, a shoe's size, or drawn"),
        "U",
    ),
    _tool(
        "brush",
        lambda: tr("Brush"),
        lambda: tr("Raise, lower or smooth the surface with strokes"),
        "B",
    ),
    _tool(
        "plane",
        lambda: tr("Reference plane"),
        lambda: tr("A plane to look at the foot against"),
        "R",
        lambda: tr("Plane"),
    ),
    _tool(
        "section",
        lambda: tr("Section"),
        lambda: tr("Cut the insole and measure its thickness"),
        "S",
    ),
    _prescription(
        lambda: tr("Posting"),
        lambda: tr("Tilt rear- and forefoot by degrees"),
        lambda: Posting(rearfoot_deg=4.0),
    ),
    _prescription(
        lambda: tr("Forefoot twist"),
        lambda: tr("Turn the forefoot against the rearfoot"),
        lambda: ForefootTwist(angle_deg=4.0),
    ),
    _prescription(
        lambda: tr("Heel skive"),
        lambda: tr("A wedge in the heel cup, medial or lateral"),
        HeelSkive,
    ),
    _prescription(lambda: tr("Heel lift"), lambda: tr("Raise the whole heel"), HeelLift),
    _prescription(lambda: tr("Heel cup"), lambda: tr("Set the depth of the heel cup"), HeelCup),
    _prescription(
        lambda: tr("Arch raise"), lambda: tr("Raise the medial arch about its apex"), ArchRaise
    ),
    _preset(Preset.PLANTAR, 1, lambda: tr("Plantar")),
    _preset(Preset.MEDIAL, 2, lambda: tr("Medial")),
    _preset(Preset.LATERAL, 3, lambda: tr("Lateral")),
    _preset(Preset.POSTERIOR, 4, lambda: tr("Posterior")),
    _preset(Preset.ANTERIOR, 5, lambda: tr("Anterior")),
    _preset(Preset.DORSAL, 6, lambda: tr("Dorsal")),
    ActionRecord(
        "fit",
        lambda: tr("Show all"),
        lambda: tr("Show the whole foot and the whole insole"),
        lambda rooms, _on: rooms.stage.fit(),
        icon="fit",
        shortcut="F",
        needs_foot=True,
    ),
    ActionRecord(
        "linked",
        lambda: tr("Linked views"),
        lambda: tr("Foot and insole turn together"),
        lambda rooms, on: rooms.appearance.set_linked(on),
        icon="link",
        shortcut="L",
        checkable=True,
    ),
    _map(MapKind.NONE, lambda: tr("Shaded"), lambda: tr("Show the insole in its material"), "0"),
    _map(MapKind.HEIGHT, lambda: tr("Height map"), lambda: tr("Colour by height"), "H"),
    _map(MapKind.THICKNESS, lambda: tr("Thickness map"), lambda: tr("Colour by thickness"), "M"),
    _map(
        MapKind.FIT,
        lambda: tr("Fit map"),
        lambda: tr("Colour by the distance of the insole from the foot"),
        "I",
    ),
    _map(
        MapKind.DIFFERENCE,
        lambda: tr("Difference map"),
        lambda: tr("Colour by the difference to what stands beside, mirrored where it has to be"),
        "J",
    ),
    ActionRecord(
        "contours",
        lambda: tr("Contour lines"),
        lambda: tr("Lines of equal height, a millimetre apart"),
        lambda rooms, on: rooms.stage.insole_presenter.show_contours(on),
        shortcut="N",
        checkable=True,
        needs_foot=True,
    ),
    ActionRecord(
        "ghost",
        lambda: tr("Insole through the foot"),
        lambda: tr("Show the insole below the foot, seen through"),
        lambda rooms, on: rooms.stage.foot_presenter.show_ghost(on),
        shortcut="G",
        checkable=True,
        needs_foot=True,
    ),
    ActionRecord(
        "wireframe",
        lambda: tr("Wireframe"),
        lambda: tr("Show the edges of the insole's triangles alone"),
        lambda rooms, on: rooms.stage.insole_presenter.show_wireframe(on),
        shortcut="W",
        checkable=True,
        needs_foot=True,
    ),
    ActionRecord(
        "dark",
        lambda: tr("Dark theme"),
        lambda: tr("Light text on a dark ground"),
        lambda rooms, on: rooms.appearance.set_dark(on),
        icon="dark",
        checkable=True,
    ),
    ActionRecord(
        "touch",
        lambda: tr("Touch mode"),
        lambda: tr("Large targets for fingers"),
        lambda rooms, on: rooms.appearance.set_touch(on),
        checkable=True,
    ),
    _language("system", lambda: tr("Language of the system")),
    _language("en", lambda: "English"),
    _language("sv", lambda: "Svenska"),
    ActionRecord(
        "print_outline",
        lambda: tr("Print outline 1:1…"),
        lambda: tr("Write the outline of the insole in true size as a PDF"),
        lambda rooms, _on: rooms.exporting.ask_print_outline(),
        shortcut="Ctrl+P",
        needs_foot=True,
    ),
    ActionRecord(
        "confirm_landmarks",
        lambda: tr("Confirm landmarks"),
        lambda: tr("Take all landmarks as they are shown"),
        lambda rooms, _on: rooms.prescribing.confirm_landmarks(),
        shortcut="Ctrl+K",
        needs_foot=True,
    ),
    ActionRecord(
        "find_landmarks",
        lambda: tr("Find landmarks anew"),
        lambda: tr("Forget the landmarks that were set by hand"),
        lambda rooms, _on: rooms.prescribing.find_landmarks(),
        needs_foot=True,
    ),
    ActionRecord(
        "copy_measures",
        lambda: tr("Copy the measures"),
        lambda: tr("Put the table of measures onto the clipboard"),
        lambda rooms, _on: rooms.measuring.copy(),
        shortcut="Ctrl+Shift+M",
        needs_foot=True,
    ),
    ActionRecord(
        "save_measures",
        lambda: tr("Save measures as CSV…"),
        lambda: tr("Write the table of measures for a spreadsheet"),
        lambda rooms, _on: rooms.measuring.ask_save(),
        needs_foot=True,
    ),
    ActionRecord(
        "save_template",
        lambda: tr("Save as template…"),
        lambda: tr("Save the prescription without the patient, for other feet"),
        lambda rooms, _on: rooms.prescribing.ask_save_template(),
        needs_foot=True,
    ),
    ActionRecord(
        "apply_template",
        lambda: tr("Apply template…"),
        lambda: tr("Prescribe what a template holds; one of the other side is mirrored"),
        lambda rooms, _on: rooms.prescribing.ask_apply_template(),
        needs_foot=True,
    ),
    ActionRecord(
        "repeat_design",
        lambda: tr("Repeat the design of a case…"),
        lambda: tr("Prescribe on this scan what an earlier case prescribes"),
        lambda rooms, _on: rooms.prescribing.ask_repeat_design(),
        needs_foot=True,
    ),
    ActionRecord(
        "tour",
        lambda: tr("Take the tour"),
        lambda: tr("The window in five steps"),
        lambda rooms, _on: rooms.guide.begin_tour(),
        shortcut="F1",
    ),
    ActionRecord(
        "calibrate",
        lambda: tr("Calibrate sensors…"),
        lambda: tr("Turn a sensor from the box into a measuring device"),
        lambda rooms, _on: rooms.calibrate.open(),
    ),
    ActionRecord(
        "compare",
        lambda: tr("Compare surfaces…"),
        lambda: tr("How far feet, insoles and scans of moulds differ"),
        lambda rooms, _on: rooms.compare.open(),
    ),
    ActionRecord(
        "about",
        lambda: tr("About Insole Studio"),
        lambda: tr("Version and licence"),
        lambda rooms, _on: rooms.guide.show_about(),
    ),
)
