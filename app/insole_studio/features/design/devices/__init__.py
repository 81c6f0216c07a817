"""The list of devices, findings and base forms, and the table of materials."""
