"""./sofof accept, with scripts of a moment in a repository of its own. Exits
with 77 where there is no git."""

import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

SKIPPED = 77
SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent

# It passes by one line, and notes each run of its own.
SCRIPT = """#!/usr/bin/env bash
# Measures little.
#
# Depends on: world/road.cpp world/lane.cpp
set -euo pipefail
source "$(dirname "${{BASH_SOURCE[0]}}")/table"
echo {name} "$@" >>"$root/../ran"
title
{body}
finish
"""
PASSES = 'zero "collisions" 0'
FAILS = 'zero "collisions" 1'


class Accept(unittest.TestCase):

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.root = self.folder / "repository"
        scripts = self.root / "tests" / "acceptance"
        scripts.mkdir(parents=True)
        (self.root / "docs").mkdir()
        shutil.copy(SOURCE / "sofof", self.root)
        for name in ("accept", "table"):
            shutil.copy(SOURCE / "tests" / "acceptance" / name, scripts)
        self.write(".gitignore", "build/\n")
        for name in ("world/road.cpp", "world/lane.cpp", "README.md"):
            self.write(name, "first\n")
        self.script("main_job", PASSES)
        self.script("planner", PASSES)
        self.git("init", "-q")
        self.commit()

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def script(self, name, body, more=""):
        text = SCRIPT.format(name=name, body=body)
        text = text.replace("set -euo", more + "set -euo", 1)
        self.write(f"tests/acceptance/{name}", text).chmod(0o755)

    def git(self, *arguments):
        return subprocess.run(
            ["git", "-C", self.root, "-c", "user.name=a", "-c",
             "user.email=a@b.c", *arguments],
            check=True, capture_output=True, text=True).stdout.strip()

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "A change")
        return self.git("rev-parse", "--short=8", "HEAD")

    def accept(self, *arguments, code=0):
        """What it prints; what ran is in ran()."""
        (self.folder / "ran").unlink(missing_ok=True)
        done = subprocess.run([self.root / "sofof", "accept", *arguments],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def ran(self):
        file = self.folder / "ran"
        return file.read_text().splitlines() if file.exists() else []

    def states(self, *arguments):
        listed = self.accept("--list", *arguments)
        return dict(re.split(r"\s{2,}", line)[:2]
                    for line in listed.splitlines())

    def page(self):
        return (self.root / "docs" / "promises.md").read_text()

    def test_all_run_once_and_are_kept_with_their_commit(self):
        commit = self.git("rev-parse", "--short=8", "HEAD")
        self.assertEqual(self.states(),
                         {"main_job": "never run", "planner": "never run"})
        self.accept()
        self.assertEqual(self.ran(), ["main_job", "planner"])
        again = self.accept()
        self.assertEqual(self.ran(), [])
        self.assertIn(commit, again)
        self.assertRegex(again, r"collisions +\| 0 +\| 0 +\| pass")

    def test_again_runs_what_is_valid(self):
        self.accept()
        self.accept("planner", "--again")
        self.assertEqual(self.ran(), ["planner"])

    def test_results_that_are_committed_stay_valid(self):
        self.write("docs/guide.md", "first\n")
        self.script("printed", PASSES, "# Depends on: docs tests/acceptance\n")
        self.commit()
        self.accept()
        self.commit()
        self.assertEqual(set(self.states().values()), {"valid"})

    def test_a_changed_dependency_makes_results_stale(self):
        self.accept()
        self.write("world/road.cpp", "second\n")
        self.commit()
        self.assertEqual(self.states(),
                         {"main_job": "stale", "planner": "stale"})
        self.accept()
        self.assertEqual(self.ran(), ["main_job", "planner"])

    def test_a_changed_script_makes_its_own_result_stale(self):
        self.accept()
        self.script("planner", PASSES + "\nzero 'off road' 0")
        self.commit()
        self.assertEqual(self.states(),
                         {"main_job": "valid", "planner": "stale"})

    def test_any_other_change_leaves_results_valid(self):
        self.accept()
        self.write("README.md", "second\n")
        self.write("world/sign.cpp", "new\n")
        self.commit()
        self.accept()
        self.assertEqual(self.ran(), [])

    def test_what_is_not_committed_is_measured_and_not_kept(self):
        self.write("world/road.cpp", "not committed\n")
        self.assertIn("not kept", self.accept("main_job"))
        self.assertEqual(self.ran(), ["main_job"])
        self.assertEqual(self.states()["main_job"], "never run")

    def test_an_interruption_loses_the_running_part_only(self):
        self.script("planner", 'zero "first line" 0\nsleep 60')
        self.commit()
        for number in (signal.SIGTERM, signal.SIGINT):
            child = subprocess.Popen([self.root / "sofof", "accept"],
                                     stdout=subprocess.DEVNULL,
                                     stderr=subprocess.DEVNULL)
            deadline = time.monotonic() + 20
            while not self.ran()[-1:] == ["planner"]:
                self.assertLess(time.monotonic(), deadline)
                time.sleep(0.02)
            child.send_signal(number)
            self.assertEqual(child.wait(20), 128 + number)
            self.assertEqual(self.states(),
                             {"main_job": "valid", "planner": "never run"})
        self.assertEqual(
            [path.name for path in
             (self.root / "tests/acceptance/measured").iterdir()],
            ["main_job.full"])
        self.script("planner", PASSES)
        self.commit()
        self.accept()
        self.assertEqual(self.ran(), ["planner"])

    def test_a_failing_line_ends_with_1_once_all_others_have_run(self):
        self.script("main_job", FAILS + "\n" + PASSES)
        self.commit()
        self.assertIn("1 failed", self.accept(code=1))
        self.assertEqual(self.ran(), ["main_job", "planner"])
        self.assertIn("1 failed", self.accept(code=1))
        self.assertEqual(self.ran(), [])

    def test_a_test_that_checks_nothing_has_not_passed(self):
        for assertions, verdict in ((0, "FAIL"), (1, "pass")):
            self.write("tests/binary", "#!/bin/sh\n"
                       "echo 'test cases: 1 | 1 passed | 0 failed'\n"
                       f"echo 'assertions: {assertions} | all passed'\n"
                       ).chmod(0o755)
            self.script("main_job",
                        'tests=$root/tests/binary; tested "it" "it is" "so"')
            self.commit()
            self.assertIn(verdict, self.accept("main_job", "--again",
                                               code=int(verdict == "FAIL")))

    def test_a_script_that_breaks_off_fails_and_is_not_kept(self):
        self.script("main_job", PASSES + "\nfalse")
        self.commit()
        self.assertIn("before its end", self.accept(code=1))
        self.assertEqual(self.states()["main_job"], "never run")

    def test_what_is_not_permitted_here_is_not_measured(self):
        self.script("main_job", "exit 77")
        self.commit()
        self.assertIn("not permitted here", self.accept())
        self.assertEqual(self.states()["main_job"], "not measured here")
        self.assertIn("not measured: not permitted", self.page())

    def test_what_is_not_permitted_here_leaves_what_others_measured(self):
        self.accept()
        self.script("main_job", "exit 77")
        self.commit()
        self.accept()
        self.assertEqual(self.states()["main_job"], "stale")
        self.assertIn("## main_job", self.page())

    def test_an_unknown_name_ends_with_2_and_the_nearest(self):
        said = self.accept("planer", code=2)
        self.assertEqual(said, "accept: there is no script planer; the "
                               "nearest is planner.\n")
        self.assertEqual(self.ran(), [])

    def test_short_forms_have_results_of_their_own(self):
        self.accept("--short", "main_job")
        self.assertEqual(self.ran(), ["main_job --short"])
        self.assertEqual(self.states("--short")["main_job"], "valid")
        self.assertEqual(self.states()["main_job"], "never run")
        self.assertEqual(self.git("status", "--porcelain"), "")

    def test_parts_run_and_become_stale_one_by_one(self):
        self.script("attacks", PASSES, "# Parts: cars local\n")
        self.commit()
        self.accept("attacks:local")
        self.assertEqual(self.ran(), ["attacks local"])
        self.accept("attacks")
        self.assertEqual(self.ran(), ["attacks cars"])
        self.accept("attacks", "--short")
        self.assertEqual(self.ran(), ["attacks --short"])

    def test_a_dependency_that_does_not_exist_is_refused(self):
        self.script("main_job", PASSES, "# Depends on: wolrd\n")
        self.assertIn("depends on wolrd", self.accept(code=2))

    def test_the_page_shows_what_is_kept_and_what_is_missing(self):
        self.accept("main_job")
        page = self.page()
        self.assertIn("| [planner](../tests/acceptance/planner) | "
                      "never measured in full |", page)
        self.assertIn("| collisions | 0 | 0 | pass |", page)
        self.assertIn("Measured in full: 1 of 2 scripts or parts.", page)
        day = self.git("show", "-s", "--format=%cs", "HEAD").strip()
        self.assertRegex(page, rf"\| passed \| 1 \| `\w{{8}}` \| {day} \|")
        self.accept("--check-page")
        self.write("docs/promises.md", page.replace("pass", "PASS"))
        self.assertIn("--page", self.accept("--check-page", code=1))
        self.accept("--page")
        self.assertEqual(self.page(), page)


if __name__ == "__main__":
    if not shutil.which("git"):
        print("Skipped: no git is installed.")
        sys.exit(SKIPPED)
    for name in ("SHARED_MACHINE", "GIT_DIR", "GIT_INDEX_FILE"):
        os.environ.pop(name, None)
    unittest.main()
