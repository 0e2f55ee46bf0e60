"""TextureImages: the images of textures as small JPEG or PNG files for the page, within a budget."""

import io
import logging
import warnings
from typing import NamedTuple

from usd2kg.errors import SceneError
from usd2kg.scene.textures import Texture, read_texture_file
from usd2kg.studio.settings import TEXTURES

__all__ = ["TextureImage", "TextureImages"]

logger = logging.getLogger(__name__)

_FORMATS = ("PNG", "JPEG", "WEBP", "BMP", "TGA", "TIFF")
"""Formats that are decoded; Pillow has others, some of which run programs."""


class TextureImage(NamedTuple):
    """An encoded image."""

    content: bytes
    media_type: str


class TextureImages:
    """Images are decoded when they are first asked for; each that cannot be used is warned about once."""

    def __init__(self) -> None:
        self._known: dict[str, TextureImage | None] = {}
        """File of a texture → its image; None if it is not shown."""
        self._size = 0

    def image(self, texture: Texture) -> TextureImage | None:
        """Return the image of a texture; None if its file is missing, broken, too large, or beyond the budget."""
        key = texture.file or texture.name
        if key not in self._known:
            try:
                found = _shrink(read_texture_file(texture, TEXTURES.max_file_bytes))
                if self._size + len(found.content) > TEXTURES.max_scene_bytes:
                    raise SceneError(f"the textures of the scene have more than {TEXTURES.max_scene_bytes:,} bytes")
                self._size += len(found.content)
                self._known[key] = found
            except SceneError as error:
                logger.warning("texture %s: %s; its display colour is shown", texture.name, error)
                self._known[key] = None
        return self._known[key]


def _shrink(content: bytes) -> TextureImage:
    """Return an image with sides of at most `max_side` pixels, encoded again.

    Raises:
        SceneError: it cannot be decoded, or has too many pixels.
    """
    from PIL import Image  # noqa: PLC0415 - an extra

    try:
        with warnings.catch_warnings(), Image.open(io.BytesIO(content), formats=_FORMATS) as opened:
            warnings.simplefilter("ignore")
            if opened.width * opened.height > TEXTURES.max_pixels:
                raise SceneError(f"the image has {opened.width}x{opened.height} pixels, which is too many")
            # JPEG can be decoded at a fraction of its size.
            opened.draft("RGB", (TEXTURES.max_side, TEXTURES.max_side))
            opened.thumbnail((TEXTURES.max_side, TEXTURES.max_side))
            image = opened.convert("RGB")
    except SceneError:
        raise
    # Decoders of broken files raise nearly anything: struct.error, SyntaxError, EOFError, ...
    except Exception as error:
        raise SceneError("the image cannot be decoded") from error
    target = io.BytesIO()
    is_small = max(image.size) <= TEXTURES.max_lossless_side
    image.save(target, "PNG" if is_small else "JPEG", quality=TEXTURES.jpeg_quality)
    return TextureImage(target.getvalue(), "image/png" if is_small else "image/jpeg")
