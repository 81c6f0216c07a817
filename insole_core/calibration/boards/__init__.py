"""Boards in pictures and depth: cameras and the pose between them.

``board.Board`` is what is printed, ``intrinsics.find_boards`` finds it,
``boards_in_depth.read_boards_in_depth`` reads it from depth.
"""
