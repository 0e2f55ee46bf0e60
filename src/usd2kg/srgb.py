"""The transfer function of sRGB, between light and the values of pixels (IEC 61966-2-1, section 5.2)."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["linear_from_srgb", "srgb_from_linear"]


def linear_from_srgb(encoded: ArrayLike) -> NDArray[np.float64]:
    """Return linear light of sRGB values in [0, 1], of any shape.

    >>> linear_from_srgb([0, 0.04045, 0.5, 1]).round(4).tolist()
    [0.0, 0.0031, 0.214, 1.0]
    """
    values = np.asarray(encoded, np.float64)
    return np.where(values <= 0.04045, values / 12.92, ((np.maximum(values, 0) + 0.055) / 1.055) ** 2.4)


def srgb_from_linear(light: ArrayLike) -> NDArray[np.float64]:
    """Return sRGB values of linear light, of any shape; light outside [0, 1] is clipped.

    >>> srgb_from_linear([-1, 0.0031308, 0.214, 2]).round(3).tolist()
    [0.0, 0.04, 0.5, 1.0]
    """
    values = np.clip(np.asarray(light, np.float64), 0, 1)
    return np.where(values <= 0.0031308, values * 12.92, 1.055 * values ** (1 / 2.4) - 0.055)
