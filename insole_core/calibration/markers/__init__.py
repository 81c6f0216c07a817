"""The survey of a reference system by its own pictures.

``marker_survey.survey_markers`` measures a ``marker_survey.MarkerSurvey``;
``reference_file.load_reference_system`` reads and ``reference_file.save_reference_system`` keeps
it.
"""
