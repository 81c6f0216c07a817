"""The emulated Kinect: the device's side of the protocol, below pyusb.

`bus.EmulatedBus` is a pyusb backend on which emulated sensors play frames as live ones; everything
else here needs the standard library only, so that another emulator (of the kernel's USB files, for
libusb itself) can use the same device.
"""
