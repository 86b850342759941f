"""What pages print, held to runs that are made up."""

import importlib.machinery
import importlib.util
import pathlib
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
loader = importlib.machinery.SourceFileLoader(
    "printed_figures", str(SOURCE / "tests/acceptance/printed_figures"))
spec = importlib.util.spec_from_loader(loader.name, loader)
printed = importlib.util.module_from_spec(spec)
loader.exec_module(printed)


class MadeUpRuns:
    """Of one run, with these figures."""

    def __init__(self, **figures):
        self.figures = figures

    def value(self, expression):
        return self.figures[expression]


PAGE = "Six cars take\n16.2 ms, and −3 of 289\nfall back; 16.2 is all.\n"
SENTENCE = {"page": "docs/x.md", "text": "cars take {} ms, and {} of {} fall",
            "values": ["ms", "lost", "all"]}


def sentence(**figures):
    entry = SENTENCE | {"times": figures.pop("times")} if "times" in figures \
        else SENTENCE
    return printed.check_sentence(PAGE, entry, MadeUpRuns(**figures))


class Sentences(unittest.TestCase):

    def test_the_last_printed_digit_counts(self):
        text, line = sentence(ms=16.2499, lost=-3.2, all=289)
        self.assertEqual(text, PAGE)
        self.assertEqual(line[1:], ("16.2, −3, 289", "16.2, −3, 289", True))
        self.assertFalse(sentence(ms=16.2501, lost=-3, all=289)[1][3])

    def test_what_differs_is_written_where_it_stood(self):
        text, line = sentence(ms=20.04, lost=-4, all=289)
        self.assertFalse(line[3])
        self.assertEqual(text, "Six cars take\n20.0 ms, and −4 of 289\nfall "
                               "back; 16.2 is all.\n")

    def test_a_computing_time_may_be_some_times_another(self):
        self.assertTrue(sentence(ms=30, lost=-3, all=150, times=2)[1][3])
        self.assertFalse(sentence(ms=33, lost=-3, all=289, times=2)[1][3])

    def test_a_sentence_that_has_changed_is_asked_for(self):
        with self.assertRaises(SystemExit):
            printed.check_sentence("Six lorries", SENTENCE, MadeUpRuns())


STUDY = """Curves end at 1.5 s.

**Claims that these runs measure**

| claim | verdict | ours |
| --- | --- | --- |
| rises | reproduced | 1.5 s |
| cost_20_hz | in part | 0.25 % |

**Computing time in the vehicle, percent of one core**

| who | active |
| --- | --- |
| ours | {} |
"""


def lines_of_study(made, page):
    with tempfile.TemporaryDirectory() as folder:
        files = [pathlib.Path(folder) / x for x in ("made.md", "page.md")]
        files[0].write_text(made)
        files[1].write_text(page + "\n## How this page was made\nso.\n")
        lines = list(printed.study(*files, True))
        return lines, files[1].read_text()


class Study(unittest.TestCase):

    def test_rows_are_as_printed_but_for_computing_times(self):
        lines, page = lines_of_study(STUDY.format("0.5"), STUDY.format("0.3"))
        self.assertEqual([x[1] for x in lines], ["4 of 4 rows", "3 of 3 rows", "1 of 1"])
        self.assertIn("| ours | 0.5 |", page)
        self.assertTrue(page.endswith("\n## How this page was made\nso.\n"))
        other = STUDY.format("9").replace("1.5", "1.6")
        lines, _ = lines_of_study(other, STUDY.format("0.3"))
        self.assertEqual([x[1] for x in lines], ["3 of 4 rows", "2 of 3 rows", "0 of 1"])
        self.assertEqual([x[3] for x in lines], [False, False, False])

    def test_a_verdict_counts_but_for_computing_times(self):
        page = STUDY.format("1")
        for made, rows in (("in part", "4 of 4"), ("reproduced", "3 of 4")):
            lines, _ = lines_of_study(page.replace(made, "contradicts"), page)
            self.assertEqual(lines[0][1], f"{rows} rows")
        lines, _ = lines_of_study(page.replace("0.25", "2.5"), page)
        self.assertEqual(lines[0][1], "3 of 4 rows")

    def test_a_table_that_has_gone_or_is_new_is_told(self):
        first, second = STUDY.format("1").split("\n**Computing")
        for made, page in ((first, STUDY), (STUDY, first)):
            lines, _ = lines_of_study(made.format("1"), page.format("1"))
            self.assertEqual([x[3] for x in lines], [True, False, True])


if __name__ == "__main__":
    unittest.main()
