"""A case: a patient, up to two feet, their prescriptions; and its file.

``case_record.CaseRecord`` is the value, ``case_file.read_case`` and ``case_file.write_case`` its
file.
"""
