"""Recorded sessions: reading, checking, writing.

``session.Session`` is the value, ``reader.read_session`` reads it, ``writer.write_session`` writes
it, ``hand_edits.HandEdits`` is what a user said of it.
"""
