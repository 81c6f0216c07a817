"""One view: its readings, mesh, colours and quality.

``measured_view.measure_view`` makes a ``measured_view.MeasuredView``.
"""
