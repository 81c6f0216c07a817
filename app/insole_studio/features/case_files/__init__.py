"""New, open, save and recover.

``case_files.CASE_FILE_ACTIONS`` of ``case_files.CaseFiles``.
"""
