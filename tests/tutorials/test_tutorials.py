"""The runner of tutorials on pages that are right, and wrong; the index.
Called with the program, or with none."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PROGRAM = sys.argv.pop() if len(sys.argv) > 1 else "/bin/true"


def run(text, *more):
    """@returns exit code, what was said, and the page afterwards."""
    with tempfile.TemporaryDirectory() as place:
        page = pathlib.Path(place) / "page.md"
        page.write_text(text)
        done = subprocess.run(
            [sys.executable, "-B", HERE / "run", "--sofof", PROGRAM, *more,
             page],
            capture_output=True, text=True)
        return (done.returncode, (done.stdout + done.stderr).replace(
            str(page), "page.md"), page.read_text())


class Pages(unittest.TestCase):

    def says(self, text, code, what):
        got, said, _ = run(text)
        self.assertEqual(got, code, said)
        self.assertIn(what, said)

    def test_outputs_files_and_variables_are_the_pages_own(self):
        self.says("# A\n`d/x.txt`:\n```toml\na = 1\n```\n"
                  "```sh\nb=2\ncat d/x.txt; ls sofof/README.md\n```\n"
                  "```text\na = 1\nsofof/README.md\n```\n"
                  "```sh\necho $b\n```\n```text\n2\n```\n",
                  0, "page: 2 blocks, 2 outputs")

    def test_a_command_that_fails_is_named_by_its_line(self):
        self.says("# A\n\n```sh\ntrue\n(exit 3)\n```\n", 1,
                  "page.md:5: ends with 3")

    def test_an_output_that_differs_is_named_by_its_line(self):
        self.says("# A\n```sh\nprintf 'a\\nb\\nc\\n'\n```\n"
                  "```text\na\n…\nd\n```\n", 1, "page.md:8: this is not printed, but")

    def test_what_is_printed_besides_differs_too(self):
        self.says("# A\n```sh\nprintf 'a\\nb\\n'\n```\n```text\na\n```\n", 1,
                  "page.md:7:")

    def test_dots_stand_for_anything(self):
        self.says("# A\n```sh\nprintf 'a 12 b\\nx\\ny\\n'\n```\n"
                  "```text\na … b\n…\n```\n", 0, "1 outputs")

    def test_a_section_without_its_tool_is_left_out_aloud(self):
        self.says("# A\n## B\nThis needs `no-such-tool`.\n```sh\nfalse\n```\n"
                  "## C\n```sh\ntrue\n```\n", 77,
                  "page.md:3: SKIPPED, for there is no no-such-tool")

    def test_a_block_of_which_nobody_knows_the_file_is_refused(self):
        self.says("# A\nText.\n```toml\na = 1\n```\n", 1,
                  "page.md:3: which file")

    def test_a_page_that_builds_is_left_out_without_a_clone(self):
        self.says("# A\n```sh\nsofof setup\n```\n", 77, "SKIPPED")

    def test_nothing_goes_on_in_the_background(self):
        code, said, _ = run("# A\n```sh\nsleep 1234.5 &\n```\n")
        self.assertEqual(code, 0, said)
        left = subprocess.run(["pgrep", "-f", "^sleep 1234.5"])
        self.assertNotEqual(left.returncode, 0)

    def test_update_writes_what_is_printed(self):
        *_, page = run("# A\n```sh\necho b\n```\n```text\na\n```\n", "--update")
        self.assertIn("```text\nb\n```", page)


class Index(unittest.TestCase):

    def test_every_page_has_its_task(self):
        index = (ROOT / "docs" / "index.md").read_text()
        pages = [x.name for x in (ROOT / "docs").glob("*.md")
                 if x.name != "index.md"]
        pages += [f"tutorials/{x.name}"
                  for x in (ROOT / "docs" / "tutorials").glob("*.md")]
        self.assertEqual([x for x in pages if f"({x}" not in index], [])

    def test_the_gallery_shows_ten_scenarios_that_are_there(self):
        text = (ROOT / "docs" / "gallery.md").read_text()
        pictures = {x for x in text.replace(")", "(").split("(")
                    if x.startswith("pictures/")}
        self.assertEqual(len(pictures), 10)
        for word in text.split():
            if word.startswith("config/"):
                self.assertTrue((ROOT / word).exists(), word)


if __name__ == "__main__":
    unittest.main()
