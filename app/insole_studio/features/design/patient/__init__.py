"""The patient, the measures of the foot, and the variants."""
