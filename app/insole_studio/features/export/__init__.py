"""Check & export: the order, its checks, its files.

``export_actions.EXPORT_ACTIONS`` of ``export_actions.ExportActions``.
"""
