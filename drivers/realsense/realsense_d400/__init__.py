"""Driver of RealSense cameras of the D400 series, over the library of their maker.

Begin in `cameras.py`, which lists and opens cameras, and `camera.py`, an open one. The library,
`pyrealsense2`, is imported only once a camera is plugged in, played or emulated.
"""
