"""Backups: made, kept by a rule, checked, restored.

``back_up.back_up``, ``back_up.KeepRule``, ``snapshot.check_backup``, ``restore.restore``.
"""
