"""A driver for the Kinect v1 (Xbox 360 models 1414 and 1473, and Kinect for Windows) on pyusb.

Start with `kinect_v1.kinect_camera.open_camera` and `kinect_v1.sensors.list_sensors`; see the
README and PROTOCOL.md beside this file for the rest. This file imports nothing, so that the
emulated device, which needs only the standard library, runs under any Python.
"""
