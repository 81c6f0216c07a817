"""The three models, and their USB functions."""

from __future__ import annotations

from enum import Enum

VENDOR = 0x045E
CAMERA_PRODUCTS = (0x02AE, 0x02BF)
MOTOR_PRODUCT = 0x02B0
AUDIO_PRODUCTS = (0x02AD, 0x02BE, 0x02C3, 0x02BB)
PRODUCTS = (*CAMERA_PRODUCTS, MOTOR_PRODUCT, *AUDIO_PRODUCTS)

_RELEASE_1414 = 0x010B
_PRODUCT_K4W = 0x02BF


class Model(Enum):
    """The models of the Kinect v1."""

    XBOX_1414 = "1414"
    XBOX_1473 = "1473"
    WINDOWS = "K4W"

    @property
    def has_motor_function(self) -> bool:
        """Whether motor, LED and accelerometer are a USB function of their own."""
        return self is Model.XBOX_1414

    @property
    def streaming_alternate(self) -> int:
        """The alternate setting of the camera's interface that holds the endpoints."""
        return 1 if self is Model.WINDOWS else 0

    @property
    def fixed_parameter_bytes(self) -> int:
        """Length of the reply to the command for fixed parameters."""
        return 322 if self is Model.XBOX_1414 else 334


def function_name(product: int) -> str:
    """Return a name for a USB function, by its idProduct."""
    if product in CAMERA_PRODUCTS:
        return "camera"
    return "motor" if product == MOTOR_PRODUCT else "audio part"


def camera_model(product: int, release: int) -> Model:
    """Return the model with the camera's idProduct and bcdDevice."""
    if product == _PRODUCT_K4W:
        return Model.WINDOWS
    return Model.XBOX_1414 if release == _RELEASE_1414 else Model.XBOX_1473
