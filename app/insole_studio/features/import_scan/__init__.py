"""The scan of another program: shown, and asked what its file does not tell.

``scan_import.ScanImport``.
"""
