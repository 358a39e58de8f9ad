"""PNG pictures of browsers, read and compared by Python's standard library."""
import struct
import zlib

FAR = 48  # of 255: a pixel that differs by more looks different


def unfilter(kind, line, above, step):
    out = bytearray(line)
    for i in range(len(out)):
        left = out[i - step] if i >= step else 0
        up = above[i]
        corner = above[i - step] if i >= step else 0
        if kind == 1:
            out[i] = (out[i] + left) & 255
        elif kind == 2:
            out[i] = (out[i] + up) & 255
        elif kind == 3:
            out[i] = (out[i] + (left + up) // 2) & 255
        elif kind == 4:
            guess = left + up - corner
            near = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))
            out[i] = (out[i] + near[2]) & 255
    return out


def read_png(data):
    """Width, height, rows of an 8-bit RGBA picture."""
    width, height = struct.unpack(">II", data[16:24])
    packed, at = b"", 8
    while at < len(data):
        n, kind = struct.unpack(">I4s", data[at:at + 8])
        packed += data[at + 8:at + 8 + n] if kind == b"IDAT" else b""
        at += 12 + n
    raw, step = zlib.decompress(packed), 4
    above, rows = bytearray(step * width), []
    for y in range(height):
        begin = y * (step * width + 1)
        above = unfilter(raw[begin], raw[begin + 1:begin + 1 + step * width], above, step)
        rows.append(above)
    return width, height, rows


def pixel(rows, x, y):
    return tuple(rows[y][4 * x:4 * x + 3])


def difference(one, other):
    """Mean difference of two PNG files' pixels, by the colour that differs most, of 255; share of pixels that differ by more than FAR."""
    (width, height, got), (wide, high, wanted) = read_png(one), read_png(other)
    if (width, height) != (wide, high):
        return 255, 1
    off = [max(abs(a - b) for a, b in zip(pixel(got, x, y), pixel(wanted, x, y))) for y in range(height) for x in range(width)]
    return sum(off) / len(off), sum(o > FAR for o in off) / len(off)
