#!/usr/bin/env python3
"""Completes words of sofof in shells on a terminal, as people do.

usage: test_completion.py PROGRAM
"""
import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = pathlib.Path(sys.argv.pop()).resolve() if len(sys.argv) > 1 else None
ROOT = pathlib.Path(__file__).resolve().parents[2]
PATIENCE_S = 30
QUIET_S = 0.25


class Shell:
    """A shell on a terminal that completes words of sofof."""

    def __init__(self, words, ready):
        self.pid, self.terminal = pty.fork()
        if self.pid == 0:
            os.chdir(ROOT)
            os.environ.update(
                PATH=f"{PROGRAM.parent}:{os.environ['PATH']}",
                PS1="> ", TERM="dumb", HISTFILE="/dev/null", COLUMNS="500")
            os.execvp(words[0], words)
        for line in ready:
            self.send(line + "\n")
        self.send("echo rea''dy\n")
        self.until("ready\r\n")
        self.drain()

    def send(self, text):
        os.write(self.terminal, text.encode())

    def read(self, seconds):
        if not select.select([self.terminal], [], [], seconds)[0]:
            return ""
        try:
            return os.read(self.terminal, 65536).decode(errors="replace")
        except OSError:
            return ""

    def until(self, text):
        seen, end = "", time.monotonic() + PATIENCE_S
        while text not in seen:
            if time.monotonic() > end:
                raise TimeoutError(f"no {text!r} in {seen!r}")
            seen += self.read(0.1)
        return seen

    def drain(self):
        seen = ""
        while more := self.read(QUIET_S):
            seen += more
        return seen

    def complete(self, line):
        """The words of the line after a tab: another command prints them."""
        self.send(line + "\t\x01printf '<%s>' \x05; echo e''nd\n")
        seen = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]|\x07|\r", "",
                      self.until("end\r\n"))
        return re.findall(r"<([^<>%]*)>", seen.rsplit("<sofof>", 1)[-1])

    def offered(self, line):
        """What the terminal shows after the line and two tabs."""
        self.send(line + "\t\t")
        seen = self.drain()
        self.send("\x15")
        self.drain()
        return seen

    def end(self):
        os.close(self.terminal)
        os.waitpid(self.pid, 0)


class Cases:
    """What any shell completes."""

    def completes(self, line, to):
        self.assertEqual(self.shell.complete(line), to.split()[1:])

    def test_commands(self):
        self.completes("sofof repr", "sofof reproduce")

    def test_options(self):
        self.completes("sofof run --thr", "sofof run --threads")

    def test_scenarios_by_name(self):
        self.completes("sofof run ulm_l", "sofof run ulm_lehr")
        self.completes("sofof run tun", "sofof run tunnel")

    def test_files(self):
        self.completes("sofof sweep config/paper/del",
                       "sofof sweep config/paper/delay_plot.toml")

    def test_policies(self):
        self.completes("sofof policies least", "sofof policies least_loaded")

    def test_keys_of_set(self):
        self.completes("sofof run ulm_lehr --set network.prof",
                       "sofof run ulm_lehr --set network.profile=")

    def test_keys_of_any_element(self):
        self.completes("sofof run ulm_lehr --set fleet.7.first",
                       "sofof run ulm_lehr --set fleet.7.first_station=")

    def test_values_of_set(self):
        self.completes(
            "sofof run ulm_lehr --set policies.lodm=near",
            "sofof run ulm_lehr --set policies.lodm=nearest")
        self.completes("sofof run ulm_lehr --set record.trace=tr",
                       "sofof run ulm_lehr --set record.trace=true")

    def test_keys_of_services(self):
        self.completes(
            "sofof run x --set service.cabin_climate.set_p",
            "sofof run x --set service.cabin_climate.set_point_c=")

    def test_commands_in_commands(self):
        self.completes("sofof keys iss", "sofof keys issue")
        self.completes("sofof keys issue --prov",
                       "sofof keys issue --provider")

    def test_help(self):
        self.completes("sofof help che", "sofof help check")

    def test_words(self):
        self.completes("sofof completion z", "sofof completion zsh")


class Bash(Cases, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.script = tempfile.NamedTemporaryFile("w", suffix=".bash")
        subprocess.run([PROGRAM, "completion", "bash"], stdout=cls.script,
                       check=True)
        cls.shell = Shell(
            ["bash", "--norc", "--noprofile", "-i"],
            ["bind 'set enable-bracketed-paste off'",
             "bind 'set bell-style none'", f"source {cls.script.name}"])

    @classmethod
    def tearDownClass(cls):
        cls.shell.end()
        cls.script.close()

    def test_lists_by_commas(self):
        self.completes("sofof bench x --policies location,least",
                       "sofof bench x --policies location,least_loaded")

    def test_option_with_its_value(self):
        self.completes("sofof run ulm_lehr --set=policies.codm=ed",
                       "sofof run ulm_lehr --set=policies.codm=edf")

    def test_all_keys_are_offered(self):
        seen = self.shell.offered("sofof run x --set record.")
        for key in ("tracks_period", "cycles", "margins", "plans"):
            self.assertIn(f"record.{key}=", seen)


@unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
class Zsh(Cases, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        with open(f"{cls.folder.name}/_sofof", "w") as script:
            subprocess.run([PROGRAM, "completion", "zsh"], stdout=script,
                           check=True)
        cls.shell = Shell(
            ["zsh", "-f", "-i"],
            ["unsetopt zle_bracketed_paste; unset zle_bracketed_paste",
             "bindkey -e; setopt no_beep no_list_ambiguous",
             f"fpath=({cls.folder.name} $fpath)",
             f"autoload -U compinit; compinit -D -u"])

    @classmethod
    def tearDownClass(cls):
        cls.shell.end()
        cls.folder.cleanup()


class Manual(unittest.TestCase):
    @unittest.skipUnless(shutil.which("man"), "man is not installed")
    def test_page_has_no_warnings_and_all_commands(self):
        with tempfile.NamedTemporaryFile("w", suffix=".1") as page:
            subprocess.run([PROGRAM, "manual"], stdout=page, check=True)
            shown = subprocess.run(
                ["man", "--warnings", "-l", page.name], text=True,
                capture_output=True, check=True,
                env={**os.environ, "MANWIDTH": "200", "MANPAGER": "cat",
                     "LC_ALL": "C.UTF-8"})
        self.assertEqual(shown.stderr, "")
        help_text = subprocess.run([PROGRAM, "--help"], text=True,
                                   capture_output=True, check=True).stdout
        commands = re.findall(r"^  ([a-z][a-z-]+) +[A-Z]", help_text, re.MULTILINE)
        self.assertGreater(len(commands), 20)
        for command in commands:
            self.assertRegex(shown.stdout, rf"(?m)^   sofof {command}\b")


if __name__ == "__main__":
    unittest.main()
