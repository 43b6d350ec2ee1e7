"""Alpha of PNG files of 8 or 16 bits without interlace, as POV-Ray and celltrace write them."""

import math
import struct
import zlib

_CHANNELS = {0: 1, 2: 3, 4: 2, 6: 4}


def _chunks(path):
    with open(path, "rb") as file:
        data = file.read()
    place = 8
    while place + 8 <= len(data):
        size, kind = struct.unpack(">I4s", data[place:place + 8])
        yield kind, data[place + 8:place + 8 + size]
        place += 12 + size


def colour_type(path):
    """The number of PNG's header that tells which channels there are, with the bits of each."""
    return next((body[8], body[9]) for kind, body in _chunks(path) if kind == b"IHDR")


def _paeth(left, up, corner):
    p = left + up - corner
    return min((abs(p - left), 0, left), (abs(p - up), 1, up), (abs(p - corner), 2, corner))[2]


def _rows(path):
    chunks = list(_chunks(path))
    width, height, bits, kind = struct.unpack(">IIBB", dict(chunks)[b"IHDR"][:10])
    step = _CHANNELS[kind] * bits // 8
    data = zlib.decompress(b"".join(body for name, body in chunks if name == b"IDAT"))
    above = bytearray(width * step)
    for y in range(height):
        start = y * (width * step + 1)
        filtered, row = data[start], bytearray(data[start + 1:start + 1 + width * step])
        for i in range(len(row)):
            left = row[i - step] if i >= step else 0
            up, corner = above[i], above[i - step] if i >= step else 0
            row[i] = row[i] + (0, left, up, (left + up) // 2, _paeth(left, up, corner) if filtered == 4 else 0)[filtered] & 255
        above = row
        yield row


def alpha(path):
    """The alpha of all pixels, its upper 8 bits, or None where the file has none."""
    bits, kind = colour_type(path)
    if kind not in (4, 6):
        return None
    step = _CHANNELS[kind] * bits // 8
    return b"".join(bytes(row[step - bits // 8::step]) for row in _rows(path))


def alpha_psnr(a, b):
    """The PSNR of two files' alpha; None where neither has any, or both the same."""
    first, second = alpha(a), alpha(b)
    if first == second:
        return None
    if first is None or second is None or len(first) != len(second):
        return 0.0
    error = sum((x - y) ** 2 for x, y in zip(first, second)) / len(first)
    return 10 * math.log10(255 ** 2 / error)
