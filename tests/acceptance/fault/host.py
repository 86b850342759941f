"""One host: `sofof provide` or `sofof drive` in a process of its own, on a disk
of its own; for tests/acceptance/faults.

Each start makes a results folder of its own, which moves off the small disk when
the process has ended.
"""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import time

SERVICE = "trajectory_planning"
PATIENCE_S = 20.0
FAKETIME = "/usr/$LIB/faketime/libfaketimeMT.so.1"


def wait_until(holds, seconds=PATIENCE_S):
    """@returns whether it did, in time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if holds():
            return True
        time.sleep(0.02)
    return False


def begin_first(command, output):
    """Starts a process that comes before others on its cores, by its own nice
    value and by that of its session, which Linux may schedule as a group: what
    else this machine does is no fault of hosts, which have theirs to themselves.
    """
    return subprocess.Popen(
        ["sh", "-c", "echo -20 2>/dev/null >/proc/self/autogroup || true; "
         'exec nice -n -20 "$@"', "sh", *map(str, command)],
        stdout=output, stderr=output, start_new_session=True)


class Host:
    """@param space    Its network namespace.
    @param command  What to run, without the results folder.
    @param clock    A file by which libfaketime shifts its calendar, or None.
    """

    def __init__(self, name, folder, space, disk, command, clock=None):
        self.name, self.disk = name, disk
        self._folder, self._space, self._command = folder, space, command
        self._clock, self._starts, self._process = clock, 0, None
        self.is_closed = False  # for good
        self.deaths = {}  # of runs that ended on their own: exit codes

    # -- the process ------------------------------------------------------------

    def start(self):
        if self.is_closed:
            raise RuntimeError(f"{self.name} is closed")
        self._starts += 1
        self.run = f"{self.name}_{self._starts:04}"
        self.out = self.disk.at / self.run
        self._read, self._rest, self._log_read = 0, b"", 0
        self.sources = {}  # of each station: (is remote, since s of the run)
        changing = ["env", f"LD_PRELOAD={FAKETIME}", "NO_FAKE_STAT=1",
                    f"FAKETIME_TIMESTAMP_FILE={self._clock}",
                    "FAKETIME_CACHE_DURATION=1",
                    "FAKETIME_DONT_FAKE_MONOTONIC=1"] if self._clock else []
        with open(self.log, "wb") as log:
            self._process = begin_first(
                ["ip", "netns", "exec", self._space, *changing,
                 *map(str, self._command), "--out", str(self.out)], log)

    @property
    def log(self):
        return self._folder / f"{self.run}.log"

    @property
    def is_running(self):
        return self._process is not None and self._process.poll() is None

    def send(self, number):
        self._process.send_signal(number)

    def end(self, number=signal.SIGTERM):
        """@returns its exit code, once its results lie beside its log."""
        if not self.is_running:
            self.deaths[self.run] = self._process.returncode
        self.send(number)
        self.send(signal.SIGCONT)
        try:
            code = self._process.wait(PATIENCE_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            code = self._process.wait()
        self.keep()
        for left in ("faketime_shm_", "sem.faketime_sem_"):
            pathlib.Path(f"/dev/shm/{left}{self._process.pid}").unlink(True)
        return code

    def keep(self):
        if self.out.exists():
            shutil.copytree(self.out, self._folder / self.run)
            shutil.rmtree(self.out)

    def said(self, text):
        """In how many lines it has printed it."""
        return self.log.read_text(errors="replace").count(text)

    # -- how it is, as its results tell ------------------------------------------

    def zero(self):
        """Time of day at the run's time 0: its configuration is written then."""
        return os.stat(self.out / "config.toml").st_mtime

    def look(self):
        """Reads what has been written since."""
        try:
            with open(self.out / "events.jsonl", "rb") as file:
                file.seek(self._read)
                text = file.read()
        except FileNotFoundError:
            return
        self._read += len(text)
        *lines, self._rest = (self._rest + text).split(b"\n")
        for event in map(json.loads, lines):
            if event["what"] == "switch" and event["service"] == SERVICE:
                self.sources[event["station"]] = (
                    event["detail"].startswith("remote"), event["t_s"])

    def is_planned_for(self, stations, for_s):
        """Whether all its cars have been planned for, for so long."""
        self.look()
        if len(self.sources) < stations:
            return False
        now = time.time() - self.zero()
        return all(remote and now - since >= for_s
                   for remote, since in self.sources.values())
