#!/usr/bin/env python3
"""Object detection as a program: a grey JPEG in, boxes of bright cars out.

A result has a number of boxes, 4 octets, and for each of them x, y, width and
height in pixels, 2 octets each, all little endian. The picture is looked at in
an eighth of its size, to which a JPEG is decoded from the means of its blocks
alone: by PIL (python3-pil) where it is installed, in half a millisecond, else by
the code below, in twelve.
"""
import io
import struct
import sys

from service_program import Program

try:
    from PIL import Image
except ImportError:
    Image = None

SCALE = 8
BRIGHT = 180
LEAST_CELLS = 6  # of a car, in the small picture


def shrunk_by_pil(jpeg: bytes) -> tuple[int, int, bytes]:
    """Returns width, height and pixels, an eighth of the picture's."""
    with Image.open(io.BytesIO(jpeg)) as picture:
        width, height = picture.width // SCALE, picture.height // SCALE
        picture.draft("L", (width, height))
        return *picture.size, picture.tobytes()


def code_table(counts: bytes, symbols: bytes) -> list[tuple[int, int]]:
    """Returns (length, symbol) for each 16 bits that come next."""
    table: list[tuple[int, int]] = []
    k = 0
    for length, count in enumerate(counts, 1):
        for symbol in symbols[k:k + count]:
            table += [(length, symbol)] * (1 << 16 - length)
        k += count
    return table + [(16, 0)] * ((1 << 16) - len(table))


TABLES: dict[bytes, list[tuple[int, int]]] = {}


def shrunk(jpeg: bytes) -> tuple[int, int, bytes]:
    """The same of a baseline JPEG with one component, without PIL."""
    at, tables, width, height, quantum = 2, {}, 0, 0, 0
    while (marker := jpeg[at + 1]) != 0xda:
        length, = struct.unpack_from(">H", jpeg, at + 2)
        content = jpeg[at + 4:at + 2 + length]
        if marker == 0xdb:
            quantum = content[1]
        elif marker == 0xc0:
            height, width = struct.unpack_from(">HH", content, 1)
        elif marker == 0xc4:
            if content not in TABLES:
                TABLES[content] = code_table(content[1:17], content[17:])
            tables[content[0]] = TABLES[content]
        at += 2 + length
    length, = struct.unpack_from(">H", jpeg, at + 2)
    octets = jpeg[at + 2 + length:-2].replace(b"\xff\x00", b"\xff") + b"\xff" * 8
    dc_codes, ac_codes = tables[0x00], tables[0x10]
    columns, rows = width // SCALE, height // SCALE
    pixels, mean, bit = bytearray(), 0, 0
    unpack = struct.Struct(">Q").unpack_from
    for _ in range(columns * rows):
        ahead = unpack(octets, bit >> 3)[0] << (bit & 7)
        size, symbol = dc_codes[ahead >> 48 & 0xffff]
        if symbol:
            x = ahead >> 64 - size - symbol & (1 << symbol) - 1
            mean += x if x >> symbol - 1 else x + 1 - (1 << symbol)
        bit += size + symbol
        k = 1
        while k < 64:
            ahead = unpack(octets, bit >> 3)[0] << (bit & 7)
            size, symbol = ac_codes[ahead >> 48 & 0xffff]
            bit += size + (symbol & 15)
            if symbol == 0:
                break
            k += (symbol >> 4) + 1
        pixels.append(min(max(128 + mean * quantum // 8, 0), 255))
    return columns, rows, bytes(pixels)


def boxes(width: int, height: int, pixels: bytes) -> list[tuple[int, ...]]:
    """Returns the boxes of what is bright, in pixels of the small picture."""
    left = {k for k, p in enumerate(pixels) if p > BRIGHT}
    found = []
    while left:
        heap, cells = [left.pop()], []
        while heap:
            cell = heap.pop()
            cells.append(cell)
            for near in (cell - 1, cell + 1, cell - width, cell + width):
                if near in left:
                    left.remove(near)
                    heap.append(near)
        if len(cells) >= LEAST_CELLS:
            xs = [c % width for c in cells]
            ys = [c // width for c in cells]
            found.append((min(xs), min(ys), max(xs) + 1 - min(xs),
                          max(ys) + 1 - min(ys)))
    return sorted(found)


class Detector(Program):
    def run(self, time_ns: int, number: int, what: bytes) -> bytes | None:
        try:
            small = shrunk_by_pil(what) if Image else shrunk(what)
        except (OSError, struct.error, IndexError, KeyError):
            return None  # it is no JPEG that can be read
        found = boxes(*small)
        return struct.pack("<I", len(found)) + b"".join(
            struct.pack("<4H", *(SCALE * x for x in box)) for box in found)


if __name__ == "__main__":
    sys.exit(Detector().serve())
