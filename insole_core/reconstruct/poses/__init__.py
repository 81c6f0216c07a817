"""Where a sensor stood.

``registration.PoseSearch``, judged by ``pose_quality.RegistrationLimits``.
"""
