"""Which test notices a mutant: files of tests, those first that notice soon."""
import dataclasses
import os
import pathlib
import re
import resource
import shutil
import subprocess
import tempfile
import time

# After those of the mutant's own folder.
ORDER = """properties actors scenario experiments base world messages channel
    offloading policies planners network recording reference""".split()
# The program from outside, which takes long: for mutants of apps/, for those that
# no other test reaches, and for those that say so.
PROCESSES = "processes"
MOST_OCTETS = 8 << 30
# On the wall's clock, beside others: so much longer than alone.
TIMES, MORE_S = 10, 20


@dataclasses.dataclass
class TestFile:
    """All tests of a file, as ctest runs them."""
    folder: str
    name: str
    seconds: float = 0
    reached: frozenset = frozenset()  # numbers of mutants


@dataclasses.dataclass
class Outcome:
    passed: bool
    by: str
    seconds: float


def all_files(place):
    return [TestFile(folder, path.stem) for folder in [*ORDER, PROCESSES]
            for path in sorted((place.copy / "tests" / folder).glob("*.cpp"))]


def run(place, test, number=0, case="", reached=None, longest=None):
    """One process of the tests of a file, or of one case alone."""
    own = pathlib.Path(tempfile.mkdtemp(dir=place.work))
    environment = dict(os.environ, TMPDIR=str(own),
                       SOFOF_MUTANT=str(number))
    if reached:
        environment["SOFOF_REACHED_MUTANTS"] = str(reached)
    command = [place.tests / f"test_{test.folder}", "--abort-after=1",
               f"--source-file=*/{test.name}.cpp"]
    if case:
        command.append(f"--test-case={case}".replace(",", "\\,"))
    began = time.monotonic()
    try:
        done = subprocess.run(
            command, cwd=place.copy, env=environment, text=True,
            errors="replace", stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, timeout=longest,
            preexec_fn=lambda: resource.setrlimit(
                resource.RLIMIT_AS, (MOST_OCTETS, MOST_OCTETS)))
        passed, by = done.returncode == 0, noticed(done.stdout)
    except subprocess.TimeoutExpired:
        passed, by = False, "time"
    finally:
        shutil.rmtree(own, ignore_errors=True)
    return Outcome(passed, f"{test.folder}/{test.name}: {by}",
                   time.monotonic() - began)


def noticed(output):
    """The case that failed, or the assert."""
    cases = re.findall(r"^TEST CASE: +(.*)", output, re.M)
    case = cases[-1] if cases else "it ended before its end"
    found = re.search(r"^(?:.*: )?(\S+:\d+): .*Assertion `", output, re.M)
    return f"assert, {case}" if found else case


def reach(place, test):
    """Runs the tests of a file as they are, and notes what they reach."""
    reached = place.work / f"reached.{test.folder}.{test.name}"
    reached.unlink(missing_ok=True)
    outcome = run(place, test, reached=reached)
    test.seconds = outcome.seconds
    if reached.exists():
        test.reached = frozenset(
            i for i, x in enumerate(reached.read_bytes()) if x)
    reached.unlink(missing_ok=True)
    return outcome


def order_for(mutant, files):
    """Those that reach it: its own folder's first, then short ones first."""
    def rank(test):
        return (test.folder != mutant.folder, test.folder == "reference",
                test.folder == PROCESSES, test.seconds)

    reaching = [test for test in files if mutant.number in test.reached]
    from_outside = (mutant.folder == "apps"
                    or all(test.folder == PROCESSES for test in reaching))
    return sorted((test for test in reaching if test.folder != PROCESSES
                   or from_outside or test.name == mutant.processes), key=rank)


def noticed_by(place, mutant, files):
    """What notices a mutant, or None. A test that fails does so twice: what is
    only unlucky, on a busy machine, has not noticed anything."""
    named, _, case = mutant.test.partition(": ")
    for test in order_for(mutant, files):
        if named not in ("", f"{test.folder}/{test.name}"):
            continue
        longest = TIMES * test.seconds + MORE_S
        first = run(place, test, mutant.number, case, longest=longest)
        if first.passed:
            continue
        if first.by.endswith(": time"):
            return first.by
        again = run(place, test, mutant.number, case, longest=longest)
        if not again.passed:
            return again.by
    return None
