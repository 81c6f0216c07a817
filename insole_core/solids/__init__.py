"""Closed solids that a shop can make; their checks, and the orders they are made for.

``solid.insole_solid`` closes an insole, ``order.make_part`` makes, marks and checks the part of an
``order.Order``, ``export_job.ExportJob`` writes it with its papers.
"""
