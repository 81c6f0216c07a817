"""The clinic's patients: start page, person page, orders, conflicts.

``actions.RECORD_ACTIONS`` of ``patient_records.PatientRecords``.
"""
