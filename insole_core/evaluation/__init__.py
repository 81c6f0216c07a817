"""How well a sensor, and all of them together, measure; and the reports of it.

One module for each evaluation: ``wall``, ``noise``, ``resolution``, ``known_object``, ``artefact``,
``alignment``, ``chain``. What they tell becomes a ``report.Report``.
"""
