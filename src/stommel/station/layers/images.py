"""An image as a chart layer: what it is, is told by its bytes and not by its name."""

import warnings
from io import BytesIO

from PIL import Image, UnidentifiedImageError

from stommel.station.layers.bounds import LayerError

LARGEST_IMAGE = 8 << 20
"""Bytes."""
MOST_PIXELS = 20_000_000
_ALLOWED = f"a PNG or JPEG of at most {LARGEST_IMAGE >> 20} MB and {MOST_PIXELS // 1_000_000} million pixels"


def image_kind(content: bytes) -> str:
    """Return the media type of an image that can be drawn.

    Raises
    ------
    LayerError
        It is none, damaged, or too large.
    """
    if len(content) > LARGEST_IMAGE:
        raise LayerError(f"image: {len(content) / 1e6:.1f} MB; make it smaller", "image", _ALLOWED)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with Image.open(BytesIO(content), formats=("PNG", "JPEG")) as image:
                width, height = image.size
                if width * height > MOST_PIXELS:
                    raise LayerError(f"image: {width} x {height} pixels; make it smaller", "image", _ALLOWED)
                image.load()
                return "image/png" if image.format == "PNG" else "image/jpeg"
    except UnidentifiedImageError:
        raise LayerError("image: this is no PNG or JPEG", "image", _ALLOWED) from None
    except (OSError, SyntaxError, ValueError, Warning, Image.DecompressionBombError):
        raise LayerError("image: it is damaged and cannot be drawn", "image", _ALLOWED) from None
