"""The fields of the prescription, and its warnings."""
