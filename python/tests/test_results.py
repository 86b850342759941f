"""Tables: as docs/results.md describes them, and as the program writes them."""
import json
import os
import pathlib
import re
import unittest

import here
import made_up

import sofof
from sofof import program, tables

DOCS = here.CHECKOUT / "docs"
PROGRAM = os.environ.get("SOFOF")

# Options by which three short runs write every table that there is.
RUNS = {
    "all": ("ulm_lehr.toml", "20s", [], {
        "record.margins": True, "record.trace": True, "record.plans": True,
        "policies.forecast.source": "learned",
        "policies.lodm": {"name": "location", "govern": [{"name": "rss"}]}}),
    "claims": ("crossings/four_arms.toml", "20s", [], {}),
    "cpu": ("ulm_lehr.toml", "2s", ["--realtime", "--cpu"], {}),
}


def described(page: str, heading: str) -> list[str]:
    """Names of columns in the tables below a heading of a page."""
    text = (DOCS / page).read_text("utf-8")
    part = re.search(rf"^## {re.escape(heading)}\n(.*?)(?=^## |\Z)", text,
                     re.M | re.S)[1]
    rows = re.findall(r"^\| ((?:`[^`]+`(?:, )?)+) \|", part, re.M)
    names = [x for row in rows for x in re.findall(r"`([^`]+)`", row)]
    if not names:  # told in a sentence
        names = re.findall(r"`([a-z_]+)`", part)
    return names


# Where each table's columns are described.
PLACES = {name: ("results.md", file) for name, file in tables.FILES.items()}
PLACES["protocol_trace"] = ("trace.md", "protocol_trace.csv")
PLACES["quality"] = ("policies/place_forecast.md", "What is learned")


class Documents(unittest.TestCase):

    def test_each_column_is_described_and_each_described_one_is_known(self):
        for name, columns in tables.TABLES.items():
            if name in ("distributions", "events", "protocol_trace"):
                continue  # told in sentences, an example, and below
            with self.subTest(name):
                found = set(described(*PLACES[name]))
                self.assertEqual({x.name for x in columns},
                                 found - NOT_COLUMNS.get(name, set()))

    def test_those_of_events(self):
        text = (DOCS / "results.md").read_text("utf-8")
        line = re.search(r'^ +(\{"t_s":.*\})$', text, re.M)[1]
        self.assertEqual(list(json.loads(line)),
                         [x.name for x in tables.TABLES["events"]])

    def test_those_of_the_trace(self):
        text = (DOCS / "trace.md").read_text("utf-8")
        for x in tables.TABLES["protocol_trace"]:
            self.assertIn(f"`{x.name}`", text)

    def test_each_file_of_the_results_page_is_a_table(self):
        text = (DOCS / "results.md").read_text("utf-8")
        listed = re.findall(r"^\| `([a-z_]+)\.(?:csv|jsonl)` \|", text, re.M)
        self.assertEqual(set(listed), set(tables.TABLES))

    def test_types_follow_the_rule_of_the_readme(self):
        text = (here.PACKAGE / "README.md").read_text("utf-8")
        for dtype in tables.DTYPE_OF_LETTER.values():
            self.assertIn(f"`{dtype}`", text)
        for name, columns in tables.TABLES.items():
            for x in columns:
                if tables.unit_of(x.name) and x.name != "services_ms":
                    self.assertEqual((x.dtype, x.unit),
                                     ("float64", tables.unit_of(x.name)), x)
                if x.name in ("station", "counter", "provider_id", "cycle"):
                    self.assertIn(x.dtype, ("int64", "Int64"), (name, x))
                    self.assertIsNone(x.unit)

    def test_units_of_names(self):
        for name, unit in (("latency_ms", "ms"), ("t_s", "s"), ("x_m", "m"),
                           ("comfort_cost_m2ps3", "m^2/s^3"), ("left", None),
                           ("min_accel_mps2", "m/s^2"), ("speed_mps", "m/s"),
                           ("busy_share", "1"), ("uplink_wait_ms", "ms")):
            self.assertEqual(tables.unit_of(name), unit)


# Words in a description that are set like columns.
NOT_COLUMNS = {
    "timing": {"wall_s", "x_real_time", "lodm_decisions", "codm_"},
}


@here.needs("numpy", "pandas")
class MadeUp(here.InFolder):

    def test_a_table_has_its_types_and_units(self):
        run = sofof.load(made_up.run(self.folder / "a"))
        cycles = run.cycles
        self.assertIs(run.cycles, cycles)  # read once
        self.assertEqual(cycles.attrs["units"]["latency_ms"], "ms")
        self.assertNotIn("station", cycles.attrs["units"])
        self.assertTrue(cycles["doubt_ms"].isna().all())
        self.assertEqual(str(cycles["used"].dtype), "bool")
        self.assertTrue(run.finished and run.safe)

    def test_a_name_that_looks_like_nothing_stays_a_name(self):
        run = sofof.load(made_up.run(self.folder / "a"))
        file = run.folder / "episodes.csv"
        file.write_text(file.read_text().replace("mec", "NA"))
        self.assertEqual(set(run.episodes["provider"]), {"NA"})
        self.assertTrue(run.episodes["because"].isna().all())

    def test_of_a_killed_run_a_cut_line_is_left_out(self):
        folder = made_up.run(self.folder / "a")
        (folder / "summary.json").unlink()
        file = folder / "cycles.csv"
        file.write_bytes(file.read_bytes()[:-30])
        run = sofof.load(folder)
        self.assertEqual(len(run.cycles), 399)
        self.assertFalse(run.finished or run.safe)

    def test_a_cut_line_of_a_finished_run_is_an_error(self):
        folder = made_up.run(self.folder / "a")
        file = folder / "cycles.csv"
        file.write_text(file.read_text() + "101,mec,x")
        with self.assertRaisesRegex(sofof.SofofError, "cycles.csv: "):
            sofof.load(folder).cycles

    def test_events_without_provider_have_none(self):
        folder = made_up.run(self.folder / "a")
        (folder / "events.jsonl").write_text(
            '{"t_s":1.5,"what":"arrived","station":101,"provider":"",'
            '"provider_id":0,"service":"","counter":0,"detail":"ü"}\n')
        events = sofof.load(folder).events
        self.assertTrue(events["provider"].isna().all())
        self.assertEqual(events["detail"][0], "ü")

    def test_a_table_that_was_not_written(self):
        run = sofof.load(made_up.run(self.folder / "a"))
        with self.assertRaisesRegex(sofof.SofofError, "no claims.csv"):
            run.claims
        with self.assertRaisesRegex(AttributeError, "tables are events"):
            run.cicles
        self.assertEqual(run.tables(), ["episodes", "cycles", "tracks"])

    def test_a_sweep_and_a_leaderboard(self):
        sweep = sofof.Sweep(made_up.sweep(self.folder / "s"), "made_up")
        self.assertEqual(sweep.axes, ["gap", "profile"])
        self.assertEqual(len(sweep.table), 36)
        board = sofof.Leaderboard(made_up.bench(self.folder / "b"))
        self.assertEqual(list(board.of()["entrant"]),
                         ["mine", "edf", "location"])
        with self.assertRaisesRegex(sofof.SofofError, "no scenario 'x'"):
            board.of("x")


class Words(here.InFolder):

    def test_values_as_toml(self):
        for value, text in ((True, "true"), (2, "2"), (0.5, "0.5"),
                            ('a"b\\\n', '"a\\"b\\\\\\u000a"'),
                            ([1, "x"], '[1, "x"]'),
                            ({"name": "edf", "most": 0.5},
                             '{ "name" = "edf", "most" = 0.5 }')):
            self.assertEqual(program.toml(value), text)
        with self.assertRaises(TypeError):
            program.toml(None)

    def test_what_a_program_complained_of(self):
        said = "note\nsofof: one thing\nsofof: x.toml:1:2: wrong,\n  really\n"
        self.assertEqual(program.sentence_of(said, ""),
                         "x.toml:1:2: wrong,\n  really")
        self.assertEqual(program.sentence_of("", "nothing"), "nothing")

    def test_a_program_that_is_not_there(self):
        self.addCleanup(os.environ.__setitem__, "SOFOF", PROGRAM or "")
        os.environ["SOFOF"] = str(self.folder / "none")
        with self.assertRaisesRegex(sofof.SofofError, "no such program"):
            program.find()

    def test_a_folder_without_results(self):
        with self.assertRaisesRegex(sofof.SofofError, "no results folder"):
            sofof.load(self.folder)


@unittest.skipUnless(PROGRAM, "NOT TESTED: SOFOF names no program")
@here.needs("numpy", "pandas")
class Program(here.InFolder):

    def test_every_table_loads_with_its_types(self):
        seen = set()
        for name, (scenario, length, options, set_) in RUNS.items():
            run = sofof.run(here.CONFIG / scenario, set=set_, duration=length,
                            out=self.folder / name, options=options)
            for table in run.tables():
                seen.add(table)
                self.check(run, table)
        self.assertEqual(seen, set(tables.TABLES))

    def check(self, run: sofof.Results, name: str):
        frame = run.table(name)
        columns = tables.TABLES[name]
        self.assertEqual(list(frame), [x.name for x in columns], name)
        for x in columns:
            self.assertEqual(str(frame[x.name].dtype), x.dtype, (name, x))
            self.assertEqual(frame.attrs["units"].get(x.name), x.unit)
        text = (run.folder / tables.FILES[name]).read_text("utf-8")
        lines = len(text.splitlines()) - (name != "events")
        self.assertEqual(len(frame), lines, name)

    def test_wrong_input_is_an_exception_with_the_programs_sentence(self):
        for changes, sentence in (
                ({"policies.lodm": "nearst"}, 'did you mean "nearest"'),
                ({"foo": 1}, '"foo" is no option here')):
            with self.assertRaisesRegex(sofof.SofofError, sentence) as caught:
                sofof.run(here.CONFIG / "ulm_lehr.toml", set=changes,
                          out=self.folder / "x")
            self.assertEqual(caught.exception.exit_code, 2)
        self.assertFalse((self.folder / "x").exists())

    def test_a_folder_that_holds_something_is_refused(self):
        made_up.run(self.folder / "a")
        with self.assertRaises(sofof.SofofError) as caught:
            sofof.run(here.CONFIG / "ulm_lehr.toml", duration=1,
                      out=self.folder / "a")
        self.assertEqual(caught.exception.exit_code, 2)
        self.assertTrue(sofof.load(self.folder / "a").finished)

    def test_a_sweep_has_a_line_for_each_point(self):
        sweep = sofof.sweep(
            here.CONFIG / "bench" / "mixed_fleet.toml",
            axes={"policies.lodm": ["location", "never"]}, seeds=[1, 2],
            set={"duration": "3s"}, out=self.folder / "s")
        self.assertEqual(len(sweep.table), 4)
        self.assertEqual(set(sweep.table["status"]), {"ok"})
        self.assertEqual(sweep.run(4).summary["lodm"], "never")
        self.assertEqual(sweep.run(4).summary["seed"], 2)

    def test_a_bench_has_a_leaderboard(self):
        board = sofof.bench(
            here.CONFIG / "bench" / "mixed_fleet.toml", ["location", "mine"],
            entrants={"mine": {"codm": {"name": "capacity"}}}, seeds=1,
            set={"duration": "3s"}, out=self.folder / "b")
        self.assertEqual(set(board.of()["entrant"]), {"location", "mine"})


if __name__ == "__main__":
    here.main()
