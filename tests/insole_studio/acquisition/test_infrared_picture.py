"""What a technician keeps of an infrared frame."""

from __future__ import annotations

import numpy as np

from insole_studio.acquisition.kinect_sensors import KinectVideoFrame
from kinect_v1.modes import BAYER_640, IR_640, StreamMode
from kinect_v1.streams import Frame


def frame(image: np.ndarray, mode: StreamMode = IR_640) -> Frame:
    return Frame(image, mode, number=0, device_time=0, host_time_s=0.0, discarded=0)


def test_little_light_keeps_its_steps() -> None:
    """With the emitter covered a board may span 40 of 1023 levels; all of them stay apart."""
    levels = np.zeros((488, 640), np.uint16) + np.arange(640, dtype=np.uint16) // 16 + 10
    picture = KinectVideoFrame(frame(levels), 480).preview()
    assert (picture.shape, picture.dtype) == ((480, 640), np.uint8)
    assert len(np.unique(picture)) == 40
    assert (picture.min(), picture.max()) == (0, 255)
    assert (np.diff(picture[0].astype(int)) >= 0).all()


def test_an_even_picture_and_one_of_colour() -> None:
    even = KinectVideoFrame(frame(np.full((488, 640), 500, np.uint16)), 480)
    assert not even.preview().any()
    color = KinectVideoFrame(frame(np.zeros((480, 640), np.uint8), BAYER_640), 480)
    assert (color.preview().shape, color.picture().shape) == ((240, 320, 3), (480, 640, 3))
