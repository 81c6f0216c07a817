"""Where on the foot each measure is taken, and the direction that shows it best."""

from __future__ import annotations

import numpy as np

from insole_core.cases.case_record import CaseRecord
from insole_core.geometry.arrays import FloatArray
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_studio.scene.view_camera import Preset

_HEEL_TO_TOE = ("pternion", "toe_tip_2")
_BALL = ("metatarsale_tibiale", "metatarsale_fibulare")
_ACHILLES = ("achilles_lower", "achilles_upper")
_ARCH = ("heel_centre", "arch_apex", "metatarsal_head_1")
_PLACES: dict[str, tuple[tuple[str, ...], Preset]] = {
    "foot_length": (_HEEL_TO_TOE, Preset.PLANTAR),
    "ball_width": (_BALL, Preset.PLANTAR),
    "ball_width_across": (_BALL, Preset.PLANTAR),
    "ball_length": (("pternion", "metatarsale_tibiale"), Preset.PLANTAR),
    "heel_width": (("heel_medial", "heel_lateral"), Preset.PLANTAR),
    "ball_girth": (_BALL, Preset.PLANTAR),
    "instep_height": (_ARCH, Preset.MEDIAL),
    "arch_height": (_ARCH, Preset.MEDIAL),
    "arch_height_index": (_ARCH, Preset.MEDIAL),
    "arch_index": (_ARCH, Preset.PLANTAR),
    "navicular_height": (("navicular",), Preset.MEDIAL),
    "rearfoot_angle_deg": (("calcaneus_lower", "calcaneus_upper"), Preset.POSTERIOR),
    "achilles_angle_deg": (_ACHILLES, Preset.POSTERIOR),
    "achilles_lean_deg": (_ACHILLES, Preset.POSTERIOR),
    "forefoot_angle_deg": (("metatarsal_head_1", "metatarsal_head_5"), Preset.ANTERIOR),
    "shoe_size_eu": (_HEEL_TO_TOE, Preset.PLANTAR),
    "shoe_size_uk": (_HEEL_TO_TOE, Preset.PLANTAR),
    "shoe_size_us": (_HEEL_TO_TOE, Preset.PLANTAR),
    "mondopoint": (_HEEL_TO_TOE, Preset.PLANTAR),
}


def place_of(key: str, record: CaseRecord) -> tuple[FloatArray, Preset] | None:
    """Return the place of a measure.

    Parameters
    ----------
    key
        Key of the measure.
    record
        The open case.

    Returns
    -------
    tuple or None
        Points (n, 3), mm, and viewing direction; None if the measure has no place.
    """
    names, preset = _PLACES.get(key, ((), Preset.PLANTAR))
    landmarks = landmarks_of(record)
    points = [landmarks[name].point for name in names if name in landmarks]
    return (np.array(points), preset) if points else None
