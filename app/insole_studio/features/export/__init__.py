"""Check & export: the order, its checks, its files.

``actions.EXPORT_ACTIONS`` of ``export_actions.ExportActions``.
"""
