"""How a standing foot presses on its insole: what a design changes of the pressure, in per cent.

Begin in `pressure_change`. It is a model, and says where it cannot tell.
"""
