"""A run whose decisions are made here: what environments stand on."""
import contextlib
import json
import os
import pathlib
import select
import shlex
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import tomllib
import weakref
from collections.abc import Mapping
from typing import Any

from . import hand_over, program
from .policy import PROTOCOL, Ask, Decision, line_of

PATIENCE_S = 30  # for a start and for an end; nothing waits for it as a rule
LEAVE_S = 2  # that the process of the policy may take to exit
CREDENTIALS = "3i"  # of SO_PEERCRED: process, user, group


class _Started:
    """What a run has open, and what is closed when it is over, whatever comes
    in between."""

    def __init__(self, folder: str):
        self.folder = folder
        self.process: subprocess.Popen[bytes] | None = None
        self.sockets: list[Any] = []
        self.handed_over_by: int | None = None  # a descriptor of that process

    def close(self) -> None:
        """Ends the run if it goes on, and removes what it wrote."""
        for x in self.sockets:
            with contextlib.suppress(OSError):
                x.close()  # what was not sent is of no use any more
        self.sockets = []
        try:
            if self.process and self.process.poll() is None:
                self.process.kill()
            if self.process:
                self.process.wait()
            self._end_policy()
        finally:
            shutil.rmtree(self.folder, ignore_errors=True)

    def _end_policy(self) -> None:
        """Waits for the process of the policy a little, then ends it."""
        if self.handed_over_by is None:
            return
        descriptor, self.handed_over_by = self.handed_over_by, None
        try:
            if not _readable([descriptor], LEAVE_S):
                with contextlib.suppress(ProcessLookupError):  # ended by itself
                    signal.pidfd_send_signal(descriptor, signal.SIGKILL)
        finally:
            os.close(descriptor)


def _readable(what: list[Any], timeout_s: float) -> list[Any]:
    return select.select(what, [], [], timeout_s)[0]


class Drive:
    """A run of which a scenario's LODM is here.

    It goes on while `next` waits, and stands still until `answer`. `close` may
    be called at any time, and twice; a drive that nobody refers to any more is
    closed, too.

    Args:
        scenario: its file or name.
        seed: of the run.
        set: options to change.
        duration: of the run.
        policy: options of the LODM besides: epoch_s, filter, govern.

    Raises:
        SofofError: the program is not found, or refuses the scenario.
    """

    def __init__(self, scenario: str, seed: int,
                 set: Mapping[str, object] | None = None,
                 duration: str | None = None,
                 policy: Mapping[str, object] | None = None):
        self.summary: dict[str, Any] = {}
        self._seed = seed
        self._started = _Started(tempfile.mkdtemp(prefix="sofof_"))
        self._finalizer = weakref.finalize(self, self._started.close)
        try:
            self._start(scenario, set or {}, duration, policy or {})
        except BaseException:
            self.close()
            raise

    def _start(self, scenario: str, set: Mapping[str, object],
               duration: str | None, policy: Mapping[str, object]) -> None:
        folder = pathlib.Path(self._started.folder)
        address = str(folder / "s")
        listener = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self._started.sockets.append(listener)
        listener.bind(address)
        listener.listen(1)
        command = [sys.executable, "-I", "-S", hand_over.__file__, address]
        lodm: dict[str, object] = {
            "filter": "none", "time_limit": "1h", **policy,
            "name": "process", "command": shlex.join(command)}
        quiet = {"record.cycles": False, "record.tracks": False}
        words = [program.find(), "run", scenario, "--quiet",
                 f"--seed={self._seed}", "--out", str(folder / "out"),
                 *program.settings({**quiet, **set, "policies.lodm": lodm})]
        if duration:
            words.append(f"--duration={duration}")
        with open(folder / "stderr", "wb") as stderr:
            self._process = self._started.process = subprocess.Popen(
                words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                stderr=stderr, start_new_session=True)
        self._accept(listener)

    def _accept(self, listener: socket.socket) -> None:
        ended = os.pidfd_open(self._process.pid)
        try:
            if listener not in _readable([listener, ended], PATIENCE_S):
                raise self._error()
        finally:
            os.close(ended)
        handed, _ = listener.accept()
        self._started.sockets.append(handed)
        peer = handed.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED,
                                 struct.calcsize(CREDENTIALS))
        self._started.handed_over_by = os.pidfd_open(
            struct.unpack(CREDENTIALS, peer)[0])
        _, descriptors, _, _ = socket.recv_fds(
            handed, 1, 1, socket.MSG_CMSG_CLOEXEC)
        if not descriptors:
            raise self._error()
        talk = socket.socket(fileno=descriptors[0])
        self._lines = talk.makefile("rb")
        self._talk = talk
        self._started.sockets += [self._lines, talk]
        os.unlink(listener.getsockname())
        hello = self._message()
        if not hello or hello.get("sofof") != PROTOCOL:
            raise self._error()
        self._send({"sofof": PROTOCOL, "name": "environment", "tells": True})

    def next(self) -> Ask | dict[str, Any] | None:
        """What comes next: an `Ask`, which has to be answered; what the run
        tells, as it came, of which there is much; or None: the run has come to
        its end, and `summary` is there.

        Raises:
            SofofError: the run has failed.
        """
        message = self._message()
        if message is None:
            raise self._error()
        if message["type"] == "told":
            return message
        if message["type"] == "ask":
            return Ask.of(message)
        self._finish()
        return None

    def answer(self, ask: Ask, decision: Decision) -> None:
        """Answers an ask.

        Raises:
            SofofError: the run is over.
        """
        self._send({"n": ask.n, **decision})

    def close(self) -> None:
        """Ends the run if it goes on; nothing of it stays."""
        self._finalizer()

    def _message(self) -> dict[str, Any] | None:
        try:
            line = self._lines.readline()
            whole = line.endswith(b"\n")
            message = json.loads(line.decode()) if whole else None
        except (OSError, ValueError):
            return None
        return message if isinstance(message, dict) else None

    def _send(self, message: dict[str, Any]) -> None:
        try:
            self._talk.sendall(line_of(message).encode())
        except OSError as e:
            raise self._error() from e

    def _finish(self) -> None:
        """Lets the program end in good order."""
        for x in self._started.sockets:
            x.close()
        self._started.sockets = []
        try:
            self._process.wait(PATIENCE_S)
        except subprocess.TimeoutExpired:
            raise self._error() from None
        file = pathlib.Path(self._started.folder) / "out" / "summary.json"
        if not file.is_file():
            raise self._error()
        self.summary = json.loads(file.read_text("utf-8"))
        self.close()

    def _error(self) -> program.SofofError:
        """What the program complained of; the run is closed."""
        for x in self._started.sockets:
            x.close()
        self._started.sockets = []
        try:
            code: int | None = self._process.wait(LEAVE_S)
        except subprocess.TimeoutExpired:
            code = None
        file = pathlib.Path(self._started.folder) / "stderr"
        said = file.read_text("utf-8", "replace") if file.is_file() else ""
        self.close()
        return program.SofofError(
            program.sentence_of(said, "The run ended without a word."), code)


def effective(scenario: str, set: Mapping[str, object] | None = None,
              duration: str | None = None) -> dict[str, Any]:
    """The configuration of a scenario, defaults included.

    Raises:
        SofofError: it is wrong.
    """
    words = ["check", scenario, *program.settings(set or {})]
    if duration:
        words += ["--set", f"duration={program.toml(duration)}"]
    return tomllib.loads(program.call(words))
