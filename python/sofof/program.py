"""Where the program is, how it is called, and what its errors become."""
import os
import pathlib
import shutil
import subprocess
from collections.abc import Iterable, Mapping

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]


class SofofError(RuntimeError):
    """The program said what is wrong.

    Attributes:
        sentence: what it printed.
        exit_code: 1: a run failed; 2: wrong input; 130: interrupted; None: it
            could not be started.
    """

    def __init__(self, sentence: str, exit_code: int | None = None):
        super().__init__(sentence)
        self.sentence = sentence
        self.exit_code = exit_code


def find() -> str:
    """The program: that of the variable SOFOF, else that of the checkout which
    this file is part of, built if it is not yet, else the one of PATH.

    Raises:
        SofofError: there is none.
    """
    named = os.environ.get("SOFOF")
    if named:
        found = shutil.which(named)
        if not found:
            raise SofofError(f"SOFOF={named}: there is no such program.")
        return os.path.abspath(found)
    for at in (CHECKOUT / "build" / "release" / "sofof", CHECKOUT / "sofof"):
        if at.is_file() and os.access(at, os.X_OK):
            return str(at)
    found = shutil.which("sofof")
    if not found:
        raise SofofError("The program sofof is not found: it is neither in "
                         "PATH nor named by the variable SOFOF.")
    return found


def sentence_of(stderr: str, otherwise: str) -> str:
    """What the program complained of: its last lines from "sofof: " on."""
    lines = stderr.strip().splitlines()
    starts = [i for i, x in enumerate(lines) if x.startswith("sofof: ")]
    if not starts:
        return "\n".join(lines) or otherwise
    return "\n".join(lines[starts[-1]:]).removeprefix("sofof: ")


def call(arguments: Iterable[str]) -> str:
    """Runs the program to its end.

    Args:
        arguments: of its command line.

    Returns:
        what it prints.

    Raises:
        SofofError: its exit code is not 0.
    """
    done = subprocess.run([find(), *arguments], stdin=subprocess.DEVNULL,
                          text=True, capture_output=True)
    if done.returncode != 0:
        raise SofofError(
            sentence_of(done.stderr, f"sofof ended with {done.returncode}."),
            done.returncode)
    return done.stdout


def toml(value: object) -> str:
    """A value as TOML has it, on one line.

    Raises:
        TypeError: TOML has no such value.
    """
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return '"' + "".join(map(_escaped, value)) + '"'
    if isinstance(value, os.PathLike):
        return toml(os.fspath(value))
    if isinstance(value, Mapping):
        inside = (f"{toml(str(k))} = {toml(v)}" for k, v in value.items())
        return "{ " + ", ".join(inside) + " }"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml, value)) + "]"
    if hasattr(value, "item"):  # a number of numpy
        return toml(value.item())
    if isinstance(value, (int, float)):
        return repr(value)
    raise TypeError(f"{value!r} is no text, number, list or table.")


def _escaped(c: str) -> str:
    if c in '"\\':
        return "\\" + c
    return f"\\u{ord(c):04x}" if ord(c) < 32 or ord(c) == 127 else c


def settings(changes: Mapping[str, object]) -> list[str]:
    """`--set` for each change."""
    words = []
    for key, value in changes.items():
        words += ["--set", f"{key}={toml(value)}"]
    return words
