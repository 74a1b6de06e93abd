"""The pixels of a PNG, by the standard library alone."""
import struct
import zlib


def pixels(path):
    """Width, height and the rows of an 8-bit PNG without interlacing, as bytes of its channels."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, parts = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", data[at + 8:at + 8 + size])
        elif kind == b"IDAT":
            parts += data[at + 8:at + 8 + size]
        at += 12 + size
    assert depth == 8 and interlaced == 0
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[colour]
    raw, rows, last = zlib.decompress(parts), [], bytes(width * channels)
    for y in range(height):
        kind, line = raw[y * (width * channels + 1)], bytearray(raw[y * (width * channels + 1) + 1:(y + 1) * (width * channels + 1)])
        for i in range(len(line)):
            a, b, c = (line[i - channels] if i >= channels else 0), last[i], (last[i - channels] if i >= channels else 0)
            if kind == 1:
                line[i] = (line[i] + a) & 255
            elif kind == 2:
                line[i] = (line[i] + b) & 255
            elif kind == 3:
                line[i] = (line[i] + (a + b) // 2) & 255
            elif kind == 4:
                p = a + b - c
                near = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
                line[i] = (line[i] + near) & 255
        last = bytes(line)
        rows.append(last)
    return width, height, channels, rows
