"""Maps of plantar pressure and pictures of footprints, laid over a foot.

``read_pressure.read_pressure`` reads a ``recording.PressureRecording``; laid, it is a
``laid_map.PressureMap``.
"""
