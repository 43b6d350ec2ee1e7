"""Colours as other programs say them, and those of meshes."""

import difflib
import re

import numpy

# Of matplotlib's map viridis every 16th colour, and the last one; it is in the public domain (CC0).
_VIRIDIS = ("440154 48186a 472d7b 424086 3b528b 33638d 2c728e 26828e 21918c 1fa088 28ae80 3fbc73 5ec962 84d44b addc30 "
            "d8e219 fde725").split()
_MAP_COLOURS = 256  # as many as a map of colours may have
_MOST_MATERIALS = 4096


def srgb(red, green=None, blue=None):
    """An sRGB colour, as colour pickers and matplotlib have it, as the linear one that Material and Light want.

    srgb("#1f77b4"), srgb(0.12, 0.47, 0.71), srgb((0.12, 0.47, 0.71)); a fourth number, alpha, is left out. Names such
    as "tab:blue" are matplotlib's, if that is installed. Integers in arrays of uint8 are 0 to 255. A single colour
    gives a tuple, an array of (..., 3 or 4) one of (..., 3).
    """
    if (green is None) != (blue is None):
        raise TypeError("srgb: one colour, or three numbers")
    if isinstance(red, str):
        red = _of_text(red)
    elif green is not None:
        red = (red, green, blue)
    encoded = numpy.asarray(red)
    if encoded.ndim == 0 or encoded.shape[-1] not in (3, 4) or encoded.dtype.kind not in "uif":
        raise ValueError("srgb: a colour is a text as '#1f77b4', or has three numbers")
    encoded = encoded[..., :3] / (255 if encoded.dtype == numpy.uint8 else 1)
    linear = numpy.where(encoded <= 0.04045, encoded / 12.92, ((numpy.maximum(encoded, 0) + 0.055) / 1.055) ** 2.4)
    return tuple(float(part) for part in linear) if linear.ndim == 1 else linear


def _of_text(text):
    digits = re.fullmatch("#([0-9a-fA-F]{3}|[0-9a-fA-F]{6})", text)
    if digits:
        size = len(digits[1]) // 3
        return [int(digits[1][i * size:(i + 1) * size] * (3 - size), 16) / 255 for i in range(3)]
    try:
        from matplotlib.colors import to_rgb
    except ImportError:
        raise ValueError(f"srgb: '{text}' is no colour as '#1f77b4', and there is no matplotlib that may know it") from None
    try:
        return to_rgb(text)
    except ValueError:
        raise ValueError(f"srgb: '{text}' is neither a colour as '#1f77b4' nor a name of matplotlib's") from None


def map_colours(colour_map):
    """The linear colours, (k, 3), of a map: a function of arrays of 0 to 1, an array, a name of matplotlib's, or None."""
    if isinstance(colour_map, str):
        try:
            import matplotlib
        except ImportError:
            raise ValueError(f"colour_map: '{colour_map}' is a name of matplotlib's, which is not installed") from None
        name = colour_map
        colour_map = matplotlib.colormaps.get(name)
        if colour_map is None:
            near = difflib.get_close_matches(name, matplotlib.colormaps, 1)
            raise ValueError(f"colour_map: matplotlib has no '{name}'" + (f" (did you mean '{near[0]}'?)" if near else ""))
    if colour_map is None:
        points = numpy.array([_of_text("#" + colour) for colour in _VIRIDIS])
        places = numpy.linspace(0, len(points) - 1, _MAP_COLOURS)
        colours = numpy.stack([numpy.interp(places, range(len(points)), points[:, i]) for i in range(3)], axis=1)
    elif callable(colour_map):
        colours = colour_map(numpy.linspace(0, 1, _MAP_COLOURS))
    else:
        colours = colour_map
    colours = numpy.asarray(colours)
    if colours.ndim != 2 or colours.shape[1] not in (3, 4) or not 1 <= len(colours) <= _MAP_COLOURS:
        raise ValueError(f"colour_map: has to be or to give colours of shape (n, 3 or 4), {_MAP_COLOURS} at most")
    return numpy.ascontiguousarray(srgb(colours), float)


def palette(colours):
    """A few colours, (k, 3), and for each one given the index of one that is the same or next to it."""
    colours = numpy.asarray(colours, float)
    if colours.ndim != 2 or colours.shape[1] != 3:
        raise ValueError(f"colours: the shape has to be (n, 3), and is {colours.shape}")
    finite = numpy.where(numpy.isfinite(colours), colours, 0)
    least, most = finite.min(initial=0), max(finite.max(initial=0), 1e-9)
    # In steps of equal brightness to the eye, as small as can be; each one then is the mean of the colours in it.
    eye = ((finite - least) / (most - least)) ** (1 / 2.2)
    for steps in (65535, 255, 191, 127, 95, 63, 47, 31, 23, 15):
        keys = numpy.rint(eye * steps).astype(numpy.int64) @ numpy.array([1 << 32, 1 << 16, 1])
        few, index = numpy.unique(keys, return_inverse=True)
        if len(few) <= _MOST_MATERIALS:
            break
    index = index.reshape(-1)
    sums = numpy.stack([numpy.bincount(index, finite[:, i], len(few)) for i in range(3)], axis=1)
    return sums / numpy.bincount(index, minlength=len(few))[:, None], index
