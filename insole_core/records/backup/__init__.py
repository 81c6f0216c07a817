"""Backups: made, kept by a rule, checked, restored.

``back_up.back_up``, ``pruning.KeepRule``, ``check.check_backup``, ``restore.restore``.
"""
