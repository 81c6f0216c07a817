"""Programs for routers: where a cutter goes.

``plan.plan_milling`` plans, ``gcode.gcode`` writes for a ``machine.Machine``.
"""
