#!/usr/bin/env python3
"""Runs a detector as SOFOF does, on frames of make_frames.py.

    check_frames.py FOLDER [--times FILE] COMMAND...

Prints how many cars of boxes.txt it has found, what it has found besides, and
how much computing time a frame takes; --times writes those of all frames, in
ms, as `run_times` of a scenario reads them. Ends with 1 if a car is missing.
"""
import pathlib
import resource
import struct
import subprocess
import sys
import time

from service_program import (ACTIVATE, CONFIGURE, HEADER, INPUT, RESULT,
                             SHUT_DOWN)

ROUNDS = 20


def main() -> int:
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    command = sys.argv[2:]
    times_file = None
    if command[0] == "--times" and len(command) > 2:
        times_file, command = pathlib.Path(command[1]), command[2:]
    expected: dict[str, list[tuple[int, ...]]] = {}
    for line in (folder / "boxes.txt").read_text().splitlines():
        name, *box = line.split()
        expected.setdefault(name, []).append(tuple(map(int, box)))
    child = subprocess.Popen(command, stdin=subprocess.PIPE,
                             stdout=subprocess.PIPE)
    assert child.stdin and child.stdout

    def send(kind: int, number: int, what: bytes = b"") -> None:
        child.stdin.write(HEADER.pack(len(what), kind, 0, 0, number) + what)
        child.stdin.flush()

    def receive() -> tuple[int, bytes]:
        length, kind, *_ = HEADER.unpack(child.stdout.read(HEADER.size))
        return kind, child.stdout.read(length)

    send(CONFIGURE, 0, b"protocol=1\n")
    receive()
    send(ACTIVATE, 0)
    # The clock of another process's computing time: CLOCK_PROCESS_CPUTIME_ID
    # with a number, see clock_getcpuclockid(3).
    clock = ~child.pid << 3 | 2

    times_ms: list[float] = []
    cars = found = besides = frames = 0
    began = time.monotonic()
    for _ in range(ROUNDS):
        for file in sorted(folder.glob("*.jpg")):
            frames += 1
            picture = file.read_bytes()
            before = time.clock_gettime(clock)
            send(INPUT, frames, picture)
            kind, what = receive()
            times_ms.append(1e3 * (time.clock_gettime(clock) - before))
            count, = struct.unpack_from("<I", what) if kind == RESULT else (0,)
            boxes = [struct.unpack_from("<4H", what, 4 + 8 * k)
                     for k in range(count)]
            real = expected.get(file.name, [])
            hits = sum(any(all(abs(a - b) <= 16 for a, b in zip(box, car))
                           for box in boxes) for car in real)
            cars, found = cars + len(real), found + hits
            besides += len(boxes) - hits
    took = time.monotonic() - began
    if times_file:
        times_file.write_text("# computing time of a cycle, ms\n"
                              + "".join(f"{x:.3f}\n" for x in times_ms))
    send(SHUT_DOWN, 0)
    child.stdin.close()
    code = child.wait()
    most = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"{found} of {cars} cars in {frames} frames, {besides} besides; "
          f"{sum(times_ms) / frames:.2f} ms of CPU time and "
          f"{1e3 * took / frames:.2f} ms a frame, {most:.0f} MiB; "
          f"it exited with {code}")
    return 0 if found == cars and code == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
