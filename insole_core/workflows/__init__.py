"""Use cases that the window and the command line share.

Among them ``make_foot`` (from a session to a foot), ``insole_builder.InsoleBuilder`` (from foot and
design to an insole), ``make_order`` and ``order_package`` (to a shop).
"""
