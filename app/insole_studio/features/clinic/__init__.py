"""Administration of the clinic's record: accounts, lock, backup, merging, erasure, place.

``actions.CLINIC_ACTIONS`` of ``clinic_administration.ClinicAdministration``.
"""
