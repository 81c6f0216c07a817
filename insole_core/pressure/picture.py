"""Reads a picture of a footprint or of a flatbed scanner, and finds the print on it."""

from __future__ import annotations

import io
import math
import warnings
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
import numpy.typing as npt
from PIL import Image, ImageOps

from insole_core.errors import InputError
from insole_core.geometry.arrays import FloatArray
from insole_core.given_file import read_given
from insole_core.pressure.alignment import Contact, without_specks
from insole_core.pressure.laid_map import MOST_KEPT_PIXELS, FootprintPicture

SUFFIXES = (".png", ".jpg", ".jpeg", ".tif", ".tiff")
MOST_BYTES, MOST_PIXELS = 128 * 2**20, 80_000_000
"""A scanner's A3 page at 600 dots per inch has 70 million pixels."""
DPI = (20.0, 2400.0)
KEPT_MM = 0.5
"""Least size of a pixel of the picture that is kept."""
_SIZE_MM = (60.0, 700.0)
_KINDS = ("PNG", "JPEG", "TIFF")
_MM_PER_INCH = 25.4
_SCREEN_DPI = (72, 96)  # what programs write that know nothing of the scale
_CELL_MM = 4.0
_LEAST_CONTRAST = 12.0


@dataclass(frozen=True, eq=False)
class Picture:
    """A picture of unknown or known scale.

    Parameters
    ----------
    file
        Name of the file.
    colors : (rows, columns, 3) uint8
        RGB, upright.
    dpi
        As the file states; None where it states none, or what programs write that know none.
    """

    file: str
    colors: npt.NDArray[np.uint8]
    dpi: float | None


def read_picture_file(path: Path, too_large: InputError | None = None) -> Picture:
    """Read a PNG, JPEG or TIFF.

    Parameters
    ----------
    too_large
        What to say of one with more than `MOST_PIXELS`; by default that it be scanned coarser.

    Raises
    ------
    InputError
        When it is none, damaged, or larger than scanners make them.
    """
    content = read_given(path, MOST_BYTES)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of Pillow, about tags that nothing here reads
            warnings.simplefilter("error", Image.DecompressionBombWarning)
            with Image.open(io.BytesIO(content), formats=_KINDS) as image:
                if image.width * image.height > MOST_PIXELS:
                    raise too_large or _too_large(path)
                dpi = _dpi_of(image)
                upright = ImageOps.exif_transpose(image)
                colors = np.asarray(_on_white(upright), dtype=np.uint8)
    except InputError:
        raise
    except (Image.DecompressionBombWarning, Image.DecompressionBombError) as error:
        raise too_large or _too_large(path) from error
    except (OSError, ValueError, SyntaxError) as error:
        raise InputError(
            "{path} is no readable PNG, JPEG or TIFF; save the picture again.", path=path
        ) from error
    return Picture(path.name, colors, dpi)


def with_dpi(picture: Picture, dpi: float | None = None) -> FootprintPicture:
    """Return a picture in its size, by dots per inch.

    Parameters
    ----------
    dpi
        As the user states; None takes that of the file.

    Raises
    ------
    InputError
        When neither is known, or the picture then is not as large as one of a foot.
    """
    stated = picture.dpi if dpi is None else dpi
    if stated is None:
        raise InputError(
            "{file} does not say how many dots per inch it has; state them, or click two points "
            "whose distance is known.",
            file=picture.file,
        )
    if not DPI[0] <= stated <= DPI[1]:
        raise InputError(
            "{dpi:g} dots per inch are none of a scanner; they must be {low:g} to {high:g}.",
            dpi=stated,
            low=DPI[0],
            high=DPI[1],
        )
    return _scaled(picture, _MM_PER_INCH / stated)


def with_distance(
    picture: Picture,
    first: tuple[float, float],
    second: tuple[float, float],
    distance_mm: float,
) -> FootprintPicture:
    """Return a picture in its size, by two of its points and their distance.

    Parameters
    ----------
    first, second
        Column and row, px.

    Raises
    ------
    InputError
        When the points are too near, or the picture then is not as large as one of a foot.
    """
    apart = math.dist(first, second)
    if apart < 10 or not distance_mm > 0:
        raise InputError(
            "The two points are too near to each other for a scale; click two that are far apart."
        )
    return _scaled(picture, distance_mm / apart)


def contact_of_picture(picture: FootprintPicture) -> Contact:
    """Return where a picture shows the print: dark on a light ground, or light on a dark one.

    Raises
    ------
    InputError
        When nothing stands out from the ground.
    """
    grey = cv2.cvtColor(picture.colors, cv2.COLOR_RGB2GRAY)
    cells = max(round(_CELL_MM / picture.pitch_mm), 1)
    size = (max(grey.shape[1] // cells, 1), max(grey.shape[0] // cells, 1))
    small = cv2.resize(grey, size, interpolation=cv2.INTER_AREA)
    _, dark = cv2.threshold(small, 0, 1, cv2.THRESH_BINARY_INV + cv2.THRESH_OTSU)
    on = dark.astype(bool)
    border = np.concatenate([on[0], on[-1], on[:, 0], on[:, -1]])
    on = ~on if border.mean() > 0.5 else on
    if not on.any() or on.all():
        raise _nothing_seen()
    difference = abs(float(small[on].mean()) - float(small[~on].mean()))
    load = _filled(np.where(on, 1.0, 0.0))
    if difference < _LEAST_CONTRAST or not load.any():
        raise _nothing_seen()
    pitch = picture.colors.shape[1] * picture.pitch_mm / size[0]
    along = picture.colors.shape[0] * picture.pitch_mm / size[1]
    return Contact(load, (pitch, along))


def _filled(load: FloatArray) -> FloatArray:
    """Close the gaps of a grid of ink, and leave out specks."""
    closed = cv2.morphologyEx(load.astype(np.uint8), cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8))
    return without_specks(closed.astype(np.float64))


def _scaled(picture: Picture, pixel_mm: float) -> FootprintPicture:
    rows, columns = picture.colors.shape[:2]
    longest = max(rows, columns) * pixel_mm
    if not _SIZE_MM[0] <= longest <= _SIZE_MM[1]:
        raise InputError(
            "The picture would be {longest:.0f} mm long, and a picture of a foot is {low:.0f} to "
            "{high:.0f} mm; check the dots per inch or the distance.",
            longest=longest,
            low=_SIZE_MM[0],
            high=_SIZE_MM[1],
        )
    fewer = math.sqrt(rows * columns / MOST_KEPT_PIXELS)
    pitch_mm = max(pixel_mm, KEPT_MM, pixel_mm * fewer)
    size = max(round(columns * pixel_mm / pitch_mm), 1), max(round(rows * pixel_mm / pitch_mm), 1)
    if size == (columns, rows):
        colors = picture.colors
    else:
        colors = np.asarray(cv2.resize(picture.colors, size, interpolation=cv2.INTER_AREA))
    return FootprintPicture(colors.astype(np.uint8), columns * pixel_mm / size[0])


def _on_white(image: Image.Image) -> Image.Image:
    """Return an image as RGB; what is transparent is white."""
    if image.mode in ("I;16", "I", "F"):
        grey = np.asarray(image, dtype=np.float64)
        span = max(float(np.ptp(grey)), 1e-9)
        image = Image.fromarray(((grey - grey.min()) / span * 255).astype(np.uint8))
    if "A" not in image.getbands() and "transparency" not in image.info:
        return image.convert("RGB")
    full = image.convert("RGBA")
    white = Image.new("RGBA", full.size, (255, 255, 255, 255))
    return Image.alpha_composite(white, full).convert("RGB")


def _dpi_of(image: Image.Image) -> float | None:
    stated = image.info.get("dpi")
    if not isinstance(stated, tuple) or len(stated) != 2:
        return None
    across, along = float(stated[0]), float(stated[1])
    if not (math.isfinite(across) and math.isclose(across, along, rel_tol=0.02)):
        return None
    if not DPI[0] <= across <= DPI[1] or round(across) in _SCREEN_DPI:
        return None
    return across


def _too_large(path: Path) -> InputError:
    return InputError(
        "{path} has more than {most} million pixels; scan it with fewer dots per inch.",
        path=path,
        most=MOST_PIXELS // 1_000_000,
    )


def _nothing_seen() -> InputError:
    return InputError(
        "No footprint stands out on the picture; choose one with an even background, or lay it by "
        "hand."
    )
