"""What a pad is prescribed as.

A pad without a kind is named by its shape. A clinic's library may hold kinds of its own; they are
named as they are written.
"""

from __future__ import annotations

PAD_NAMES = {
    "egg": "pelott",
    "bar": "metatarsal bar",
    "outline": "free-hand pad",
    "flat_outline": "flat pad",
    "oval": "oval pad",
    "arch_support": "arch support",
    "cut_out": "cut-out",
    "mortons_extension": "Morton's extension",
    "reverse_mortons_extension": "reverse Morton's extension",
    "dancers_pad": "dancer's pad",
    "first_ray_cut_out": "1st-ray cut-out",
    "fifth_ray_cut_out": "5th-ray cut-out",
    "relief_base_5": "relief at the base of the 5th metatarsal",
    "cuboid_raise": "cuboid raise",
    "heel_spur_recess": "heel-spur recess",
    "forefoot_filler": "forefoot filler",
    "relief_head_1": "relief under the 1st head",
    "relief_head_2": "relief under the 2nd head",
    "relief_head_3": "relief under the 3rd head",
    "relief_head_4": "relief under the 4th head",
    "relief_head_5": "relief under the 5th head",
    "relief_toe_1": "relief under the 1st toe",
    "relief_toe_2": "relief under the 2nd toe",
    "relief_toe_3": "relief under the 3rd toe",
    "relief_toe_4": "relief under the 4th toe",
    "relief_toe_5": "relief under the 5th toe",
    "toe_filler_1": "filler for the 1st toe",
    "toe_filler_2": "filler for the 2nd toe",
    "toe_filler_3": "filler for the 3rd toe",
    "toe_filler_4": "filler for the 4th toe",
    "toe_filler_5": "filler for the 5th toe",
}
"""Names of kinds and of shapes whose identifier says too little."""
