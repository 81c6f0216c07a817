"""Foam boxes and casts: the sole that was pressed into something.

``foam_box.find_imprints`` finds imprints; ``form.Form`` says what a scan is of.
"""
