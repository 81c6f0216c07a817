"""Menus and toolbar as tables of action keys."""

from __future__ import annotations

from collections.abc import Callable

from insole_core.insole.elements import in_order
from insole_studio.languages import LANGUAGES
from insole_studio.texts import tr

SEPARATOR = ""
MAPS = "maps"
"""Placeholder for the colour maps in the toolbar."""
PADS = "pads"
"""Placeholder for the library's pads in the menu."""
RECENT = "recent"
"""Placeholder for the recent files in the menu."""


def _added(name: str) -> tuple[str, ...]:
    """Return the keys of what adds a correction of a type."""
    return (f"add_{name}", "add_arch_height") if name == "arch_raise" else (f"add_{name}",)


MAP_KEYS = (
    "map_none",
    "map_height",
    "map_thickness",
    "map_fit",
    "map_difference",
    "map_pressure",
    "map_load",
)
LANGUAGE_KEYS = ("language_system", *(f"language_{code}" for code in LANGUAGES))
BESIDE_KEYS = ("beside_nothing", "beside_foot", "beside_variant")
TOOL_KEYS = (
    "tool_orbit",
    "tool_key_point",
    "tool_turn",
    "tool_pelott",
    "tool_free_hand",
    "tool_posting",
    "tool_outline",
    "tool_rim",
    "tool_brush",
    "tool_plane",
    "tool_section",
    "tool_tape",
    "tool_plantar",
)

MENUS: tuple[tuple[Callable[[], str], tuple[str, ...]], ...] = (
    (
        lambda: tr("&Case"),
        (
            "patients",
            "new_patient",
            "new_visit",
            "new_visit_same",
            "follow_up",
            "visit_photos",
            "person_orders",
            "orders",
            SEPARATOR,
            "import_table",
            "import_cases",
            "export_patient",
            SEPARATOR,
            "new_case",
            "capture",
            "open",
            "open_session",
            "open_archive",
            "open_example",
            RECENT,
            SEPARATOR,
            "save",
            "save_as",
            "add_to_record",
            "export",
            "print_outline",
            "verify_order",
            SEPARATOR,
            "quit",
        ),
    ),
    (
        lambda: tr("&Edit"),
        (
            "undo",
            "redo",
            SEPARATOR,
            "next_correction",
            "previous_correction",
            "edit_values",
            "edit_thickness",
            "remove",
            SEPARATOR,
            "author",
        ),
    ),
    (
        lambda: tr("&View"),
        (
            "look_plantar",
            "look_medial",
            "look_lateral",
            "look_posterior",
            "look_anterior",
            "look_dorsal",
            SEPARATOR,
            "fit",
            "linked",
            SEPARATOR,
            *MAP_KEYS,
            "contours",
            "grazing_light",
            "ghost",
            "wireframe",
            SEPARATOR,
            "section_follows",
            "shoe",
            SEPARATOR,
            "next_panel",
            "previous_panel",
            SEPARATOR,
            "dark",
            "touch",
            "software_rendering",
            *LANGUAGE_KEYS,
        ),
    ),
    (
        lambda: tr("&Tools"),
        (*TOOL_KEYS, SEPARATOR, "lay_pressure", SEPARATOR, "compare", "calibrate", "print_boards"),
    ),
    (
        lambda: tr("&Prescribe"),
        (
            "choose_device",
            "toggle_as_scanned",
            "edit_materials",
            "choose_shoe",
            SEPARATOR,
            *(key for kind in in_order() if kind.tip for key in _added(kind.type)),
            PADS,
            SEPARATOR,
            "confirm_landmarks",
            "find_landmarks",
            SEPARATOR,
            "copy_measures",
            "save_measures",
            "print_measures",
            "explain_angles",
            SEPARATOR,
            "apply_template",
            "save_template",
            "repeat_design",
        ),
    ),
    (
        lambda: tr("&Feet"),
        (
            "foot_other",
            "foot_left",
            "foot_right",
            SEPARATOR,
            *BESIDE_KEYS,
            SEPARATOR,
            "mirror_foot",
            "copy_to_other",
            "copy_selected_to_other",
            "repeat_last",
            SEPARATOR,
            "variant_duplicate",
            "variant_next",
            "variant_name",
            "variant_delete",
        ),
    ),
    (
        lambda: tr("C&linic"),
        (
            "lock",
            "change_password",
            SEPARATOR,
            "merge_patients",
            "erase_patient",
            "audit_log",
            SEPARATOR,
            "backup",
            "restore_record",
            "verify_record",
            SEPARATOR,
            "accounts",
            "record_place",
            "retry_record",
        ),
    ),
    (
        lambda: tr("&Help"),
        (
            "manual",
            "tour",
            "keys",
            "news",
            SEPARATOR,
            "sample_patient",
            "remove_sample",
            SEPARATOR,
            "doctor",
            SEPARATOR,
            "licences",
            "about",
        ),
    ),
)

TOOLBAR: tuple[tuple[str, ...], ...] = (
    ("capture", "open_session", "open_archive", "save", "export"),
    TOOL_KEYS,
    ("fit", "linked", MAPS),
)
"""Sections of the toolbar."""

STRIP = ("undo", "redo")
"""Actions at the right of the step strip, always visible."""
