#!/usr/bin/env python3
"""Makes frames of a camera that nobody has: grey JPEGs of a road with cars.

    make_frames.py FOLDER [COUNT]

Each frame has 640 x 480 pixels; boxes.txt says where the cars are in it, as
`FILE X Y WIDTH HEIGHT` in pixels. The same count gives the same octets. No
package is needed: the encoder is the baseline process of ITU-T T.81 with the
tables of its annex K.
"""
import math
import pathlib
import random
import struct
import sys

WIDTH, HEIGHT = 640, 480

# T.81, annex K: quantisation and Huffman codes of luminance, and the order of
# coefficients.
QUANTA = [
    16, 11, 10, 16, 24, 40, 51, 61, 12, 12, 14, 19, 26, 58, 60, 55,
    14, 13, 16, 24, 40, 57, 69, 56, 14, 17, 22, 29, 51, 87, 80, 62,
    18, 22, 37, 56, 68, 109, 103, 77, 24, 35, 55, 64, 81, 104, 113, 92,
    49, 64, 78, 87, 103, 121, 120, 101, 72, 92, 95, 98, 112, 100, 103, 99]
DC_COUNTS = [0, 1, 5, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0]
DC_SYMBOLS = list(range(12))
AC_COUNTS = [0, 2, 1, 3, 3, 2, 4, 3, 5, 5, 4, 4, 0, 0, 1, 125]
AC_SYMBOLS = bytes.fromhex(
    "01020300041105122131410613516107227114328191a1082342b1c11552d1f0"
    "2433627282090a161718191a25262728292a3435363738393a43444546474849"
    "4a535455565758595a636465666768696a737475767778797a83848586878889"
    "8a92939495969798999aa2a3a4a5a6a7a8a9aab2b3b4b5b6b7b8b9bac2c3c4c5"
    "c6c7c8c9cad2d3d4d5d6d7d8d9dae1e2e3e4e5e6e7e8e9eaf1f2f3f4f5f6f7f8"
    "f9fa")
ZIGZAG = sorted(range(64), key=lambda k: (
    k // 8 + k % 8, k // 8 if (k // 8 + k % 8) % 2 else k % 8))
COSINES = [[(math.sqrt(0.125) if u == 0 else 0.5)
            * math.cos((2 * x + 1) * u * math.pi / 16) for x in range(8)]
           for u in range(8)]


def codes(counts, symbols):
    """Returns symbol -> (code, length)."""
    table, code, k = {}, 0, 0
    for length, count in enumerate(counts, 1):
        for _ in range(count):
            table[symbols[k]] = (code, length)
            code, k = code + 1, k + 1
        code <<= 1
    return table


class Bits:
    """A stream of bits; an octet 255 is followed by 0."""

    def __init__(self):
        self.octets, self.held, self.count = bytearray(), 0, 0

    def add(self, code, length):
        self.held, self.count = self.held << length | code, self.count + length
        while self.count >= 8:
            self.count -= 8
            octet = self.held >> self.count & 255
            self.octets += b"\xff\x00" if octet == 255 else bytes([octet])
        self.held &= (1 << self.count) - 1

    def end(self):
        if self.count:
            self.add((1 << 8 - self.count) - 1, 8 - self.count)
        return bytes(self.octets)


def transformed(block):
    """The cosine transform of 8 rows of 8, by rows, then by columns."""
    rows = [[sum(c[x] * row[x] for x in range(8)) for c in COSINES]
            for row in block]
    return [sum(COSINES[v][y] * rows[y][u] for y in range(8))
            for v in range(8) for u in range(8)]


def amplitude(bits, x, table, run=None):
    size = abs(x).bit_length()
    bits.add(*table[size if run is None else run << 4 | size])
    bits.add(x if x >= 0 else x + (1 << size) - 1, size)


def encoded(picture):
    """Returns a JPEG of rows of pixels."""
    dc_codes, ac_codes = codes(DC_COUNTS, DC_SYMBOLS), codes(AC_COUNTS, AC_SYMBOLS)
    bits, before = Bits(), 0
    for y in range(0, HEIGHT, 8):
        for x in range(0, WIDTH, 8):
            flat = transformed([[p - 128 for p in row[x:x + 8]]
                                for row in picture[y:y + 8]])
            found = [round(flat[k] / QUANTA[k]) for k in ZIGZAG]
            amplitude(bits, found[0] - before, dc_codes)
            before, run = found[0], 0
            last = max((k for k in range(64) if found[k]), default=0)
            for value in found[1:last + 1]:
                if value == 0:
                    run += 1
                    continue
                for _ in range(run // 16):
                    bits.add(*ac_codes[0xf0])
                amplitude(bits, value, ac_codes, run % 16)
                run = 0
            if last < 63:
                bits.add(*ac_codes[0])

    def segment(marker, content):
        return struct.pack(">BBH", 255, marker, len(content) + 2) + content

    return b"".join([
        b"\xff\xd8",
        segment(0xe0, b"JFIF\0\1\1\0\0\1\0\1\0\0"),
        segment(0xdb, b"\0" + bytes(QUANTA[k] for k in ZIGZAG)),
        segment(0xc0, struct.pack(">BHHB3B", 8, HEIGHT, WIDTH, 1, 1, 0x11, 0)),
        segment(0xc4, b"\x00" + bytes(DC_COUNTS) + bytes(DC_SYMBOLS)),
        segment(0xc4, b"\x10" + bytes(AC_COUNTS) + bytes(AC_SYMBOLS)),
        segment(0xda, b"\1\1\0\0\x3f\0"), bits.end(), b"\xff\xd9"])


def frame(draws):
    """Returns a picture and the boxes of its cars."""
    picture = []
    for y in range(HEIGHT):
        base = 60 + 40 * y // HEIGHT
        picture.append([base + draws.randrange(-13, 14) for _ in range(WIDTH)])
    for y in range(HEIGHT // 3, HEIGHT):  # the marks of a lane
        for x in range(WIDTH // 2 - y // 80, WIDTH // 2 + y // 80):
            if y // 40 % 2:
                picture[y][x] = 130
    boxes = []
    for slot in draws.sample(range(5), draws.randrange(1, 5)):
        width = draws.randrange(40, 81)
        height = draws.randrange(32, 65)
        left = slot * 128 + draws.randrange(8, 120 - width)
        top = draws.randrange(HEIGHT // 3, HEIGHT - 80)
        boxes.append((left, top, width, height))
        for y in range(top, top + height):
            for x in range(left, left + width):
                picture[y][x] = 225 + draws.randrange(-4, 5)
    return picture, sorted(boxes)


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    lines = []
    for k in range(int(sys.argv[2]) if len(sys.argv) == 3 else 8):
        picture, boxes = frame(random.Random(k))
        name = f"road_{k:03}.jpg"
        (folder / name).write_bytes(encoded(picture))
        lines += [f"{name} {x} {y} {w} {h}\n" for x, y, w, h in boxes]
    (folder / "boxes.txt").write_text("".join(lines))


if __name__ == "__main__":
    main()
