"""tests/mutants/run: what is broken, and that it is chosen at run time; and by
what tests/mutants/protocol says that a mutant was noticed. Exits with 77 where
there is no git or no compiler."""

import contextlib
import importlib.machinery
import importlib.util
import io
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SKIPPED = 77
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import mutant_list  # noqa: E402
import operators  # noqa: E402
import switch  # noqa: E402


def script(name):
    """One that is a program, and so has no suffix."""
    loader = importlib.machinery.SourceFileLoader(
        name, str(switch.ROOT / "tests" / "mutants" / name))
    module = importlib.util.module_from_spec(
        importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


protocol = script("protocol")

# All that is broken in reach() is seen by three calls.
SOURCE = """// A way.
#include <algorithm>
#include <cassert>
#include <cstdio>
#include <cstdlib>

constexpr int far = 250;
int calls;
void count() { ++calls; }

int reach(int a, int b) {
  assert(a + b > 0); // a - b is none
  if (a > far && b != 7)
    return far;
  count();
  std::printf("a * b = ");
  return std::min(a, b) * 3
         - (b - a);
}

int main(int, char** words) {
  const int way = reach(std::atoi(words[1]), std::atoi(words[2]));
  std::printf("%d %d", way, calls);
}
"""


def broken_forms(source):
    return [(x.operator, " ".join(x.broken.split()))
            for x in operators.sites(source)]


class Operators(unittest.TestCase):

    def test_each_operator_breaks_the_expression_or_statement_around_it(self):
        found = broken_forms(SOURCE)
        for form in [("comparison negated", "a <= far"),
                     ("and, or", "a > far || b != 7"),
                     ("condition negated", "!(a > far && b != 7)"),
                     ("statement removed", ""),
                     ("least, most", "std::max(a, b) * 3 - (b - a)"),
                     ("arithmetic", "std::min(a, b) / 3 - (b - a)"),
                     ("arithmetic", "b + a"),
                     ("constant doubled", "500")]:
            self.assertIn(form, found)

    def test_comments_texts_asserts_and_logs_are_no_sites(self):
        for text in ("// a + b", '"a + b";', "assert(a + b > 0); // true",
                     "\n#include <a + b>", 'log("a + b");',
                     "\ntemplate <int n = 250>\n"):
            self.assertEqual(
                broken_forms(f"void f() {{\n  {text}\n}}\n"), [], text)

    def test_heads_of_loops_and_initialisers_are_no_statements(self):
        for source in ("void f() {\n  for (i = 0; i < n; i = i + 1)\n    g();\n"
                       "}\n", "t::t(int n)\n    : a_{n}, b_(n) {}\n"):
            removed = [x.text for x in operators.sites(source)
                       if x.kind == "statement"]
            self.assertIn(removed, ([], ["g();"]))


class Switch(unittest.TestCase):

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def test_every_mutant_is_chosen_alone_and_lines_stay(self):
        chosen = []
        for site in operators.sites(SOURCE):
            if all(site.start >= x.end or x.start >= site.end
                   for x in chosen) and site.end < SOURCE.index("int main"):
                chosen.append(site)
        numbered = list(enumerate(chosen, 1))
        text = switch.with_mutants(SOURCE, numbered)
        self.assertEqual(text.count("\n"), SOURCE.count("\n") + 2)
        base = self.folder / "base"
        base.mkdir()
        (base / "mutant.hpp").write_text(switch.HEADER)
        (base / "mutant.cpp").write_text(switch.SOURCE)
        (self.folder / "way.cpp").write_text(text)
        subprocess.run(["c++", "-std=c++20", "-I.", "way.cpp",
                        "base/mutant.cpp", "-o", "way"], cwd=self.folder,
                       check=True)
        as_it_is = self.way(0)
        self.assertEqual(as_it_is, ["a * b = 4 1", "250 0", "250 0"])
        for number, site in numbered:
            self.assertNotEqual(self.way(number), as_it_is, site)

    def way(self, number):
        reached = self.folder / "reached"
        reached.unlink(missing_ok=True)
        said = [subprocess.run(
            [self.folder / "way", *words], text=True, capture_output=True,
            env=dict(os.environ, SOFOF_MUTANT=str(number),
                     SOFOF_REACHED_MUTANTS=str(reached))).stdout
            for words in (("2", "1"), ("251", "8"), ("251", "14"))]
        if number:
            self.assertEqual(reached.read_bytes()[number], 1)
        return said

    def test_only_what_differs_is_written(self):
        path = self.folder / "a" / "b.cpp"
        switch.write_if_new(path, b"one")
        os.utime(path, (1, 1))
        switch.write_if_new(path, b"one")
        self.assertEqual(path.stat().st_mtime, 1)
        switch.write_if_new(path, b"two")
        self.assertNotEqual(path.stat().st_mtime, 1)

    def test_two_runs_are_not_at_work_in_one_place(self):
        one, other = (switch.Place(self.folder) for _ in range(2))
        self.assertTrue(one.claim())
        self.assertFalse(other.claim())
        one.lock.close()
        self.assertTrue(other.claim())
        other.lock.close()


class Lists(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.files = switch.committed()
        cls.written = mutant_list.by_hand(cls.files)
        cls.draws = mutant_list.in_draw(cls.files, cls.written)

    def test_what_is_written_by_hand_is_in_the_sources(self):
        self.assertGreaterEqual(len(self.written), 50)

    def test_a_text_that_is_not_there_is_an_error_that_names_it(self):
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            file.write('[[mutant]]\nname = "gone"\nsays = "x"\n'
                       'file = "base/time.hpp"\ntext = "no such text"\n'
                       'broken = ""\n')
            file.flush()
            with self.assertRaises(SystemExit) as stopped:
                mutant_list.by_hand(self.files, pathlib.Path(file.name))
        self.assertEqual(stopped.exception.code, 2)

    def test_two_thirds_are_drawn_and_all_folders_have_some(self):
        drawn = sum(share for share, _ in self.draws.values())
        self.assertGreaterEqual(drawn + len(self.written), 150)
        self.assertGreaterEqual(drawn, 2 * len(self.written))
        for folder, (share, mutants) in self.draws.items():
            self.assertGreaterEqual(share, mutant_list.LEAST)
            self.assertGreater(len(mutants), share, folder)

    def test_a_change_elsewhere_draws_the_same(self):
        changed = dict(self.files)
        octets, mode = changed["base/geometry.cpp"]
        changed["base/geometry.cpp"] = (b"// One more line.\n" + octets, mode)
        again = mutant_list.in_draw(changed, self.written)
        self.assertEqual(
            [x.name for _, mutants in self.draws.values() for x in mutants],
            [x.name for _, mutants in again.values() for x in mutants])

    def test_survivors_with_a_reason_are_mutants(self):
        names = {x.name for x in self.written}
        for _, mutants in self.draws.values():
            names |= {x.name for x in mutants}
        for name in mutant_list.reasons():
            self.assertIn(name, names)

    def test_mutants_that_change_no_step_are_some_of_their_files(self):
        for name in mutant_list.reasons("no_step.md"):
            path = name.partition("#")[0]
            self.assertIn(name, [x.name for _, x in mutant_list.candidates(
                path, self.files[path][0].decode())])


class Protocol(unittest.TestCase):
    def test_a_file_that_is_renamed_ends_the_draw(self):
        with self.assertRaises(SystemExit) as end, \
                contextlib.redirect_stderr(io.StringIO()) as told:
            protocol.draw({}, 1, 10, {})
        self.assertEqual(end.exception.code, 2)
        self.assertIn("there is no offloading/requester.cpp", told.getvalue())

    def test_each_kind_of_notice_has_its_name(self):
        place = switch.Place(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, place.copy)
        place.tests.mkdir(parents=True)
        tests = place.tests / "test_properties"

        def by(does):
            tests.write_text(f"#!/bin/bash\n{does}\n")
            tests.chmod(0o755)
            return protocol.noticed(place, 1)

        self.assertIsNone(by("exit 0"))
        self.assertEqual(by("echo 'a.cpp:1: ERROR: step 7: P10: late'; exit 1"),
                         ("rule", "P10: late"))
        self.assertEqual(by("echo 'a.cpp:1: ERROR: CHECK( x )'; exit 1"),
                         ("promise", "CHECK( x )"))
        self.assertEqual(
            by("echo \"x: Assertion \\`y' failed.\"; "
               "echo 'FATAL ERROR: test case CRASHED: SIGABRT'; exit 1"),
            ("assertion", "y"))
        self.assertEqual(
            by("echo 'FATAL ERROR: test case CRASHED: SIGSEGV'; exit 1")[0],
            "crash")
        self.assertEqual(by("kill -XCPU $$")[0], "no_end")


if __name__ == "__main__":
    if not shutil.which("c++") or subprocess.run(
            ["git", "-C", switch.ROOT, "rev-parse", "HEAD"],
            capture_output=True).returncode != 0:
        sys.exit(SKIPPED)
    unittest.main()
