"""A policy that is a process and does not do what it has to.

faulty.py KIND N [SEED]: from ask N on; with the kind "mutated", its answer to it
has errors that SEED draws."""
import json
import os
import random
import signal
import sys
import time

from mirror import answer


def write(data):
    os.write(sys.stdout.fileno(), data)


def mutated(line, seed):
    """An answer with one to four errors, still on one line."""
    dice = random.Random(seed)
    line = bytearray(line)
    for _ in range(dice.randint(1, 4)):
        at = dice.randrange(len(line))
        kind = dice.randrange(4)
        if kind == 0:
            line[at] = dice.randrange(256)
        elif kind == 1:
            del line[at:at + dice.randint(1, 3)]
        elif kind == 2:
            line[at:at] = bytes(dice.randrange(256) for _ in range(3))
        else:
            line[at:at] = line[at:at + dice.randint(1, 12)]
        line = line or bytearray(b"{")
    return bytes(line).replace(b"\n", b" ")


def fail(kind, line):
    if kind == "killed":
        os.kill(os.getpid(), signal.SIGKILL)
    elif kind == "ended":
        sys.exit(3)
    elif kind == "silent":
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        time.sleep(600)
    elif kind == "slow":
        time.sleep(2)
        write(line + b"\n")
    elif kind == "babbling":
        while True:
            write(b"a" * 4096)
    elif kind == "twice":
        write(line + b"\n" + line + b"\n")
    elif kind == "wrong":
        write(line.replace(b'"do"', b'"does"') + b"\n")
    elif kind == "closed":
        os.close(0)
        os.close(1)
        time.sleep(600)
    elif kind == "mutated":
        write(mutated(line, int(sys.argv[3])) + b"\n")


def main():
    kind, when = sys.argv[1], int(sys.argv[2])
    for line in sys.stdin:
        said = json.loads(line)
        if said["type"] == "hello":
            write(b'{"sofof":1,"name":"faulty"}\n')
        elif said["type"] == "ask":
            reply = json.dumps({"n": said["n"], **answer(said)}).encode()
            if said["n"] == when:
                fail(kind, reply)
            else:
                write(reply + b"\n")


if __name__ == "__main__":
    main()
