"""New, open, save and recover.

``actions.CASE_FILE_ACTIONS`` of ``case_files.CaseFiles``.
"""
