"""A program that serves SOFOF as a function, in Python without any package.

Copy this file. What goes over standard input and output: docs/programs.md.
"""
import os
import struct
import sys

HEADER = struct.Struct("<IHHqQ")  # length, kind, 0, time in ns, number
CONFIGURE, ACTIVATE, DEACTIVATE, SHUT_DOWN, INPUT = range(1, 6)
READY, RESULT, NO_RESULT = range(16, 19)


class Program:
    """What a program does; all but `run` may be left as it is."""

    def configure(self, configuration: dict[str, str]) -> None:
        """Called once, before all else."""

    def activate(self, is_active: bool, told: dict[str, str]) -> None:
        """Inputs will come, or will not; at first it is told the `station`."""

    def run(self, time_ns: int, number: int, what: bytes) -> bytes | None:
        """Returns the result of an input; None if it has none."""
        raise NotImplementedError

    def serve(self) -> int:
        """Serves until it is told to shut down, or nobody is there any more."""
        # Whatever prints by mistake does not come between frames.
        out = os.fdopen(os.dup(1), "wb")
        os.dup2(2, 1)
        read = sys.stdin.buffer.read

        def told(lines: bytes) -> dict[str, str]:
            return dict(x.split("=", 1) for x in lines.decode().splitlines())

        def send(kind: int, time_ns: int, number: int, what: bytes = b"") -> None:
            out.write(HEADER.pack(len(what), kind, 0, time_ns, number) + what)
            out.flush()

        try:
            while len(header := read(HEADER.size)) == HEADER.size:
                length, kind, _, time_ns, number = HEADER.unpack(header)
                what = read(length)
                if len(what) < length:
                    return 0
                if kind == CONFIGURE:
                    self.configure(told(what))
                    send(READY, time_ns, number)
                elif kind in (ACTIVATE, DEACTIVATE):
                    self.activate(kind == ACTIVATE, told(what))
                elif kind == INPUT:
                    result = self.run(time_ns, number, what)
                    if result is None:
                        send(NO_RESULT, time_ns, number)
                    else:
                        send(RESULT, time_ns, number, result)
                else:
                    return 0 if kind == SHUT_DOWN else 1
        except BrokenPipeError:
            pass
        return 0
