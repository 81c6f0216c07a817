"""What features share.

``app_services.AppServices``, ``action_record.ActionRecord``, ``user_messages.UserMessages``,
``questions.Questions``, ``stage_window.StageWindow``.
"""
