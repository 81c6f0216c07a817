"""Steps of a calibration, and where their results are kept.

``sensor_store.SensorStore`` holds what is known of sensors; each step returns a
``steps.StepResult``.
"""
