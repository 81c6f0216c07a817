"""From sensors, live or emulated, to a recorded session; a process of its own.

``sensor_source.SensorSource`` says where sensors are, ``rig.Rig`` opens them, ``sensor_port`` is
what is asked of each, whatever its family, ``service_client.CaptureService`` is the process as the
window sees it, ``capture_plan`` and ``capture_runner`` are the capture.
"""
