"""The dot pattern of a device, learnt from infrared pictures of flat walls.

``infrared_walls.read_infrared_walls`` reads them, ``learnt_reference.learn_reference`` learns.
"""
