"""Reports as their readers meet them: in a browser. Called with the program;
exits with 77 where there is no Chromium."""

import base64
import collections
import csv
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zlib

import pdf
from browser import Browser, program
from look import look, rows_of

SKIPPED = 77
SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(
    os.path.abspath(__file__))))
SCENARIO = os.path.join(SOURCE, "config", "ulm_lehr.toml")


def sofof(*arguments):
    return subprocess.run([SOFOF, *arguments], check=True, text=True,
                          capture_output=True).stdout


def run(name, *more, scenario=SCENARIO):
    folder = os.path.join(WORK, name)
    sofof("run", scenario, "--quiet", "--duration", "20s", "--out", folder,
          *more)
    return folder


class Report(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.folder = run("one")
        cls.file = os.path.join(cls.folder, "report.html")
        cls.said = sofof("report", cls.folder)
        cls.seen, cls.errors = look(cls.file, cls.folder)

    def test_the_command_says_where_the_report_is(self):
        self.assertEqual(self.said, f"report in {self.file}\n")

    def test_nothing_is_wrong_on_its_console(self):
        self.assertEqual(self.errors, [])

    def test_it_asks_the_network_for_nothing(self):
        self.assertEqual(self.seen["requests"], 0)

    def test_every_vehicle_is_on_the_map(self):
        self.assertEqual(self.seen["vehicles"], 6)

    def test_scrubbing_moves_the_vehicles(self):
        self.assertEqual(self.seen["moved_by_scrubbing"], 6)
        self.assertAlmostEqual(self.seen["scrubbed_share"], 0.6, delta=0.05)

    def test_playing_moves_the_vehicles(self):
        self.assertEqual(self.seen["moved_by_playing"], 6)

    def test_space_pauses_and_the_arrow_steps(self):
        self.assertEqual(self.seen["stands_when_paused"], 1)
        self.assertAlmostEqual(self.seen["arrow_steps_s"], 1)

    def test_charts_have_a_point_for_each_line(self):
        self.assertGreater(self.seen["csv_rows"], 400)
        self.assertEqual(self.seen["points"], self.seen["csv_rows"])

    def test_tracks_are_complete(self):
        self.assertEqual(self.seen["track_points"], self.seen["track_rows"])

    def test_a_phone_need_not_scroll_sideways(self):
        self.assertLessEqual(self.seen["wider_than_phone_px"], 0)

    def test_vehicles_are_where_the_tracks_say(self):
        rows = rows_of(self.folder, "tracks.csv")[::37]
        with Browser() as page:
            page.open(self.file)
            page.run("sofof.ready")
            for row in rows:
                here = page.run(f"""(() => {{
                    sofof.players[0].clock.seek({row["t_s"]});
                    return sofof.players[0].vehicles()[0].find(
                        one => one.station == {row["station"]});
                }})()""")
                for column, name in (("x_m", "x"), ("y_m", "y"),
                                     ("speed_mps", "speed")):
                    self.assertAlmostEqual(here[name], float(row[column]),
                                           places=3)
                self.assertEqual(here["remote"], row["source"] == "remote")

    def test_a_click_on_the_strips_goes_to_that_time(self):
        with Browser() as page:
            page.open(self.file)
            page.run("sofof.ready")
            page.click(".timeline canvas", 0.5)
            self.assertAlmostEqual(page.run("sofof.players[0].clock.time"),
                                   10, delta=0.5)

    def test_tables_sort_by_the_column_that_is_clicked(self):
        with Browser() as page:
            page.open(self.file)
            page.run("sofof.ready")
            self.assertEqual(
                page.run("""(() => {
                    const table = [...document.querySelectorAll("table")].find(
                        one => one.textContent.includes("longest gap"));
                    const head = table.querySelector("th");
                    const column = () => [...table.querySelectorAll(
                        "tbody td:first-child")].map(one => one.textContent);
                    head.querySelector("button").click();
                    const up = [head.ariaSort, column()];
                    head.querySelector("button").click();
                    return JSON.stringify([...up, head.ariaSort, column()]);
                })()"""),
                json.dumps(["ascending", self.stations(),
                            "descending", self.stations()[::-1]],
                           separators=(",", ":")))

    def stations(self):
        with open(os.path.join(self.folder, "episodes.csv")) as lines:
            return sorted(line.split(",")[1] for line in lines
                          if line.startswith("requester"))


    def opened(self, page):
        page.show(1280, 900)
        page.open(self.file)
        page.run("sofof.ready")

    def test_qos_events_and_near_misses_are_counted_apart(self):
        with Browser() as page:
            self.opened(page)
            self.assertRegex(
                page.run("document.querySelector('.events summary').innerText"),
                r"^QoS events: 0 . Near misses: 0")

    def test_one_vehicle_s_results_can_be_looked_at_alone(self):
        cycles = rows_of(self.folder, "cycles.csv")
        one = cycles[0]["station"]
        service = "trajectory_planning"
        with Browser() as page:
            self.opened(page)
            page.run("sofof.draw_all()")
            self.assertEqual(page.run(f"""(() => {{
                const choice = document.querySelector(".choice select");
                choice.value = "{one}";
                choice.dispatchEvent(new Event("change"));
                const chart = sofof.charts.find(
                    one => one.title === "Latency by time");
                return Object.values(chart.points)[0];
            }})()"""), sum(row["station"] == one and row["service"] == service
                          for row in cycles))
            self.assertEqual(page.errors, [])

    def test_a_tail_is_shown_as_distribution_when_asked(self):
        with Browser() as page:
            self.opened(page)
            page.run("sofof.draw_all()")
            self.assertEqual(page.run("""(() => {
                const button = [...document.querySelectorAll(
                    ".downloads button")].find(one => one.textContent === "F");
                button.click();
                return button.textContent;
            })()"""), "1 − F, log")
            self.assertEqual(page.errors, [])

    def test_a_click_on_a_chart_goes_to_that_time(self):
        with Browser() as page:
            self.opened(page)
            page.run("""sofof.draw_all(),
                document.querySelector(".u-over").scrollIntoView(
                    {block: "center", behavior: "instant"})""")
            page.wait(0.3)
            page.click(".u-over", 0.5)
            self.assertAlmostEqual(page.run("sofof.players[0].clock.time"),
                                   10, delta=1.5)
            page.wait(0.1)
            self.assertFalse(page.run(
                "document.querySelector('.clock-line').hidden"))

    def test_all_is_drawn_on_phones_and_desks_in_light_and_dark(self):
        for width in (390, 1400):
            for dark in (False, True):
                with self.subTest(width=width, dark=dark), Browser() as page:
                    page.show(width, 900, dark=dark, mobile=width < 500)
                    page.open(self.file)
                    page.run("sofof.ready")
                    page.run("sofof.draw_all()")
                    page.wait(0.3)
                    self.assertLessEqual(page.run(
                        "document.documentElement.scrollWidth"), width)
                    ground = page.run("""getComputedStyle(
                        document.body).backgroundColor""")
                    light = sum(map(int, re.findall(r"\d+", ground)[:3]))
                    self.assertEqual(light < 3 * 128, dark, ground)
                    coloured = page.run("""[...document.querySelectorAll(
                        "canvas")].filter(({width, height}) => width && height)
                        .map((one) => {
                            const {data} = one.getContext("2d").getImageData(
                                0, 0, one.width, one.height);
                            let count = 0;
                            for (let i = 0; i < data.length; i += 4) {
                                const rgb = data.subarray(i, i + 3);
                                count += data[i + 3] > 60
                                    && Math.max(...rgb) - Math.min(...rgb) > 60;
                            }
                            return count;
                        })""")
                    charts = page.run("sofof.charts.length")
                    self.assertGreaterEqual(len(coloured), charts + 2)
                    self.assertGreater(min(coloured), 15)
                    self.assertEqual(page.errors, [])

    def test_every_column_says_what_it_means(self):
        with Browser() as page:
            self.opened(page)
            heads = page.run("""[...document.querySelectorAll(
                "section thead th")].filter(
                one => !one.closest("#section-2")).map(one => [
                    one.textContent, one.querySelector("[title]")?.title
                                     ?? one.title])""")
            self.assertGreater(len(heads), 40)
            self.assertEqual([head for head, meaning in heads
                              if not meaning], [])

    def test_every_figure_says_what_it_means(self):
        with Browser() as page:
            self.opened(page)
            terms = page.run("""[...document.querySelectorAll(
                "#section-2 tbody td:first-child")].map(
                one => one.querySelector(".term")?.title ?? "")""")
            self.assertGreater(len(terms), 60)
            self.assertNotIn("", terms)
            self.assertTrue(page.run("""(() => {
                const term = document.querySelector(".term");
                term.click();
                return !term.nextSibling.hidden
                    && term.nextSibling.textContent === term.title;
            })()"""))

    def test_pictures_and_tables_can_be_saved(self):
        folder = os.path.join(WORK, "saved")
        os.mkdir(folder)
        with Browser() as page:
            page.save_into(folder)
            self.opened(page)
            for kind in ("SVG", "PNG", "CSV"):
                buttons = page.run(f"""(() => {{
                    const all = [...document.querySelectorAll(
                        ".downloads button")].filter(
                        one => one.textContent === "{kind}");
                    window.wanted = all;
                    return all.length;
                }})()""")
                self.assertGreater(buttons, 10)
                for i in range(buttons):
                    page.run(f"wanted[{i}].click()")
                    page.wait(0.1)
            page.wait(1)
            self.assertEqual(page.errors, [])
        names = os.listdir(folder)
        for name in names:
            file = os.path.join(folder, name)
            if name.endswith(".svg"):
                picture = xml.etree.ElementTree.parse(file).getroot()
                self.assertGreater(len(picture), 3, name)
            elif name.endswith(".png"):
                with open(file, "rb") as picture:
                    self.assertEqual(picture.read(8),
                                     b"\x89PNG\r\n\x1a\n")
                self.assertGreater(os.path.getsize(file), 5000, name)
        charts = "one-Remote_results_of_trajectory_planning-"
        for name in ("one-Drive-Map_of_one.svg", "one-Drive-Map_of_one.png",
                     "one-Drive-Offloading_of_one.svg",
                     charts + "Latency_by_time.svg",
                     charts + "Latency_distribution.png",
                     "one-Key_figures-The_run.csv", "one-Episodes.csv"):
            self.assertIn(name, names)
        with open(os.path.join(folder, charts + "Latency_by_time.csv"),
                  newline="") as saved:
            rows = list(csv.DictReader(saved))
        cycles = [row for row in rows_of(self.folder, "cycles.csv")
                  if row["service"] == "trajectory_planning"]
        *rows, limit = rows
        self.assertEqual(len(rows), len(cycles))
        self.assertEqual(rows[0]["station"], cycles[0]["station"])
        self.assertEqual(limit["curve"], "limit 50 ms")

    def test_the_map_shows_all_areas(self):
        with Browser() as page:
            self.opened(page)
            self.assertTrue(page.run("""(() => {
                const {views, drives} = sofof.players[0];
                return drives.every((drive, i) => drive.providers.every(
                    ({area}) => area.every(([x, y]) => {
                        const [left, top] = [views[i].left(x), views[i].top(y)];
                        return left > 0 && left < views[i].width
                            && top > 0 && top < views[i].height;
                    })));
            })()"""))


class Paper(unittest.TestCase):
    """Who prints the page, or saves it as PDF, gets all of it."""

    @classmethod
    def setUpClass(cls):
        if not pdf.program():
            raise unittest.SkipTest("poppler-utils is not installed")
        cls.folder = run("printed")
        file = os.path.join(cls.folder, "report.html")
        sofof("report", cls.folder)
        cls.pdf = os.path.join(WORK, "printed.pdf")
        with Browser() as page:
            page.show(1280, 900, dark=True)
            page.open(file)
            page.run("sofof.ready")
            page.paper(cls.pdf)
            cls.charts = page.run("sofof.charts.map(one => one.title)")
            cls.figures = page.run("""[...document.querySelectorAll(
                "#section-2 tbody td:first-child .term")].map(
                one => one.textContent)""")
            page.run("sofof.draw_all()")
            page.run("dispatchEvent(new Event('beforeprint'))")
            cls.curves = page.run("""sofof.charts.map(({title, points}, i) => [
                title, Object.values(points).filter((count) => count).length,
                [...document.querySelectorAll("figure .on-paper svg")[i]
                    .querySelectorAll("path")].filter(
                    (one) => one.getAttribute("d").length > 5).length])""")
            cls.errors = page.errors
        cls.text = pdf.text_of(cls.pdf)
        cls.sheets = pdf.sheets_of(cls.pdf)

    def test_every_chart_has_its_title_and_its_curve(self):
        self.assertEqual(self.errors, [])
        self.assertEqual(len(self.charts), 17)
        for title in self.charts:
            self.assertIn(title, self.text)
        self.assertEqual(self.text.count("share of results, 1 − F"), 6)
        self.assertEqual(self.text.count("time, s"), 11)
        for title, curves, paths in self.curves:
            self.assertGreater(curves, 0, title)
            self.assertGreaterEqual(paths, curves, title)
        pages = pdf.words_of(self.pdf)
        for title in self.charts:
            sought = title.split()
            found = [(sheet, words[i][1:]) for sheet, words in
                     zip(self.sheets, pages) for i in range(len(words))
                     if [word[0] for word in words[i:i + len(sought)]]
                     == sought]
            coloured = [sheet.coloured(left, top + 15, left + 220, top + 200)
                        for sheet, (left, top) in found]
            self.assertEqual(len(found), self.charts.count(title), title)
            self.assertGreater(min(coloured), 15, title)

    def test_every_row_is_there(self):
        words = set(self.text.split())
        for row in rows_of(self.folder, "episodes.csv"):
            if row["side"] == "requester":
                self.assertIn(f"{float(row['ended_s']):.3f}", words)
                self.assertIn(f"{float(row['t_off_s']):.3f}", words)
        for row in rows_of(self.folder, "vehicles.csv"):
            self.assertIn(f"{float(row['comfort_cost_m2ps3']):.1f}", words)
        flat = " ".join(self.text.split())
        for figure in self.figures:
            self.assertIn(figure.split(",")[0].split()[0], flat)
        with open(os.path.join(self.folder, "config.toml")) as config:
            last = config.read().split()[-1]
        self.assertIn(last, flat)

    def test_circles_are_round_and_the_ground_is_white(self):
        sheet = self.sheets[0]
        self.assertEqual(sheet.pixels[:3], b"\xff\xff\xff")
        places = sheet.places_of((0xE8, 0xF2, 0xF8), 3)  # the area's tint
        self.assertGreater(len(places), 1000)
        wide, high = (self.extent(place[axis] for place in places)
                      for axis in (0, 1))
        self.assertAlmostEqual(wide / high, 1, delta=0.05)

    @staticmethod
    def extent(places):
        """From the first to the last line with more than a few of them."""
        lines = [line for line, count in collections.Counter(places).items()
                 if count > 20]
        return max(lines) - min(lines)


class Page(unittest.TestCase):

    def test_the_page_is_what_its_sources_make(self):
        """Else: cd apps/report && npm ci && npm run build"""
        folder = os.path.join(SOURCE, "apps", "report")
        files = ["build.mjs", "package-lock.json"]
        for place, _, names in os.walk(os.path.join(folder, "src")):
            files += [os.path.relpath(os.path.join(place, name), folder)
                      for name in names]
        digest = hashlib.sha256()
        for file in sorted(files):
            with open(os.path.join(folder, file), "rb") as content:
                digest.update(content.read())
        for name in ("report.html", "live.html"):
            with open(os.path.join(folder, "dist", name)) as page:
                self.assertTrue(
                    f"from sources {digest.hexdigest()}" in page.read())


def page_of(title, *blocks):
    """A report with these blocks; returns its file."""
    document = {"title": title, "subtitle": "", "sections": [
        {"title": title, "blocks": list(blocks)}]}
    with open(os.path.join(SOURCE, "apps", "report", "dist",
                           "report.html")) as page:
        text = page.read()
    file = os.path.join(WORK, f"{title}.html")
    with open(file, "w") as page:
        packed = base64.b64encode(zlib.compress(
            json.dumps(document).encode())).decode()
        page.write(text.replace("%title%", title).replace(
            "%document%", packed))
    return file


class LongTable(unittest.TestCase):
    """Of ten thousand vehicles."""

    def seen(self, sought):
        rows = [[str(station), f"{station % 7}.5"]
                for station in range(1001, 11001)]
        file = page_of("Many", {"kind": "table", "title": "Vehicles",
                                "columns": ["station", "stops"],
                                "rows": rows})
        with Browser() as page:
            page.show(1280, 900)
            page.open(file)
            page.run("sofof.ready")
            page.run(f"""(() => {{
                const field = document.querySelector("input[type=search]");
                field.value = {json.dumps(sought)};
                field.dispatchEvent(new Event("input"));
            }})()""")
            self.assertEqual(page.errors, [])
            return page.run("""[...document.querySelectorAll("tbody tr")].map(
                (row) => row.firstChild.textContent)""")

    def test_it_begins_with_its_first_rows(self):
        self.assertEqual(self.seen(""),
                         [str(one) for one in range(1001, 1201)])

    def test_a_vehicle_far_down_is_found(self):
        self.assertEqual(self.seen(" 10987 "), ["10987"])

    def test_what_is_not_there_leaves_nothing(self):
        self.assertEqual(self.seen("99999"), [])


class Scatter(unittest.TestCase):
    """Dots with names: some upon each other, one far away."""

    DOTS = [("never", 0, 0), ("codm:never", 0, 0), ("location", 12, 38),
            ("nearest", 12.2, 38.1), ("always", 55, 41), ("edf", 3, 20),
            ("somebody with a long name", 54, 40.5)]

    @classmethod
    def setUpClass(cls):
        dots = [{"name": name, "x": x, "y": y, "hollow": name == "always"}
                for name, x, y in cls.DOTS]
        cls.file = page_of("Dots", {
            "kind": "scatter", "title": "Dots", "x_label": "to the right",
            "y_label": "up", "dots": dots, "joined": [0, 5, 2, 3, 6],
            "caption": "A caption."})

    def seen(self, width):
        with Browser() as page:
            page.show(width, 900, mobile=width < 500)
            page.open(self.file)
            page.run("sofof.ready")
            page.wait(0.3)
            self.assertEqual(page.errors, [])
            return json.loads(page.run("""(() => {
                const box = (one) => {
                    const {left, right, top, bottom} =
                        one.getBoundingClientRect();
                    return {text: one.textContent, left, right, top, bottom};
                };
                const all = (what) => [...document.querySelectorAll(
                    ".scatter " + what)].map(box);
                return JSON.stringify({dots: all("circle"),
                                       names: all("text.name"),
                                       frame: all("svg")[0],
                                       wide: document.documentElement
                                           .scrollWidth});
            })()"""))

    def test_dots_are_where_their_figures_say(self):
        dots = self.seen(1280)["dots"]
        self.assertEqual(len(dots), len(self.DOTS))
        x = {one["text"].split(":")[0]: one["left"] for one in dots}
        y = {one["text"].split(":")[0]: one["top"] for one in dots}
        self.assertAlmostEqual(
            (x["location"] - x["never"]) / (x["always"] - x["never"]),
            12 / 55, places=3)
        self.assertAlmostEqual(
            (y["never"] - y["edf"]) / (y["never"] - y["always"]),
            20 / 41, places=3)

    def test_everybody_has_a_name_and_none_covers_another(self):
        for width in (1280, 375):
            seen = self.seen(width)
            names = seen["names"]
            for name, _, _ in self.DOTS:
                self.assertTrue(any(name in one["text"] for one in names),
                                f"{name} at {width}")
            for i, one in enumerate(names):
                self.assertGreaterEqual(one["left"], seen["frame"]["left"])
                self.assertLessEqual(one["right"], seen["frame"]["right"])
                for other in names[:i]:
                    self.assertFalse(
                        one["left"] < other["right"] - 1
                        and other["left"] < one["right"] - 1
                        and one["top"] < other["bottom"] - 2
                        and other["top"] < one["bottom"] - 2,
                        f"{one['text']} on {other['text']} at {width}")

    def test_a_phone_need_not_scroll_sideways(self):
        self.assertLessEqual(self.seen(375)["wide"], 375)


class Chain(unittest.TestCase):
    """Of a run with a chain the reader sees who runs what in one vehicle, and
    how late that responds."""

    FIGURE = """[...document.querySelectorAll("figure")].find(
        one => one.querySelector("figcaption").textContent
            === "Split and response time")"""
    CHART = """sofof.charts.find(
        one => one.title === "Split and response time")"""

    @classmethod
    def setUpClass(cls):
        cls.folder = run("chain", "--set", "provider.0.fails_at=14s",
                         scenario=os.path.join(SOURCE, "config", "chain",
                                               "dense.toml"))
        cls.file = os.path.join(cls.folder, "report.html")
        sofof("report", cls.folder)
        away = {row["station"] for row in rows_of(cls.folder, "episodes.csv")}
        drove = {row["station"] for row in rows_of(cls.folder, "vehicles.csv")}
        cls.away, cls.home = min(away), min(drove - away)

    def opened(self, page, width=1280, dark=False):
        page.show(width, 900, dark=dark, mobile=width < 500)
        page.open(self.file)
        page.run("sofof.ready")
        page.run("sofof.draw_all()")
        page.wait(0.3)

    def choose(self, page, station):
        page.run(f"""(() => {{
            const choice = ({self.FIGURE}).closest("section").querySelector(
                ".choice select");
            choice.value = "{station}";
            choice.dispatchEvent(new Event("change"));
        }})()""")

    def pixels_of(self, page, variable):
        """How many pixels of the chart have a colour of the page."""
        return page.run(f"""(() => {{
            const wanted = getComputedStyle(document.documentElement)
                .getPropertyValue("{variable}").trim();
            const rgb = [1, 3, 5].map(
                i => parseInt(wanted.slice(i, i + 2), 16));
            const one = ({self.FIGURE}).querySelector("canvas");
            const {{data}} = one.getContext("2d").getImageData(
                0, 0, one.width, one.height);
            let count = 0;
            for (let i = 0; i < data.length; i += 4)
                count += data[i + 3] === 255
                    && rgb.every((part, k) => data[i + k] === part);
            return count;
        }})()""")

    def test_one_vehicle_is_shown_with_all_its_responses(self):
        rows = rows_of(self.folder, "responses.csv")
        with Browser() as page:
            self.opened(page)
            self.assertNotIn("all", page.run(f"""[...({self.FIGURE}).closest(
                "section").querySelectorAll("option")].map(
                one => one.textContent)"""))
            for station in (self.away, self.home):
                self.choose(page, station)
                points = page.run(f"({self.CHART}).points")
                self.assertEqual(points["measured"],
                                 sum(row["station"] == station
                                     for row in rows))
                self.assertGreater(points["allowed by the scene"], 10)
                self.assertGreaterEqual(
                    points["admitted by the split's limits"], 2)
            self.assertEqual(page.errors, [])

    def test_strips_have_the_colours_of_places_in_light_and_dark(self):
        for dark in (False, True):
            with self.subTest(dark=dark), Browser() as page:
                self.opened(page, dark=dark)
                self.choose(page, self.home)
                self.assertEqual(self.pixels_of(page, "--series-0"), 0)
                self.assertGreater(self.pixels_of(page, "--street"), 3000)
                self.choose(page, self.away)
                self.assertGreater(self.pixels_of(page, "--series-0"), 3000)
                # The provider has died: what it ran has fallen back.
                self.assertGreater(self.pixels_of(page, "--street"), 3000)

    def test_places_and_fallbacks_are_in_the_legend(self):
        with Browser() as page:
            self.opened(page)
            legend = page.run(
                f"({self.FIGURE}).querySelector('.legend').innerText")
            for entry in ("measured", "allowed by the scene", "own computer",
                          "mec", "▼", "fallback"):
                self.assertIn(entry, legend)

    def test_who_is_clicked_on_the_strips_is_looked_at(self):
        with Browser() as page:
            self.opened(page)
            self.choose(page, self.home)
            page.run("document.querySelector('.timeline').scrollTop = 0")
            page.click(".timeline .room .window", 0.5)
            looked_at = page.run(f"""({self.FIGURE}).closest("section")
                .querySelector(".choice select").value""")
            self.assertNotEqual(looked_at, self.home)
            rows = rows_of(self.folder, "responses.csv")
            self.assertEqual(page.run(f"({self.CHART}).points.measured"),
                             sum(row["station"] == looked_at for row in rows))
            self.assertEqual(page.errors, [])

    def test_no_label_covers_another_on_paper_or_in_files(self):
        with Browser() as page:
            self.opened(page)
            self.choose(page, self.away)
            page.run("dispatchEvent(new Event('beforeprint'))")
            texts = json.loads(page.run(f"""(() => {{
                const paper = ({self.FIGURE}).querySelector(".on-paper");
                paper.style.display = "block";
                return JSON.stringify([...paper.querySelectorAll("text")].map(
                    (one) => {{
                        const {{left, right, top, bottom}} =
                            one.getBoundingClientRect();
                        return {{text: one.textContent, left, right, top,
                                 bottom}};
                    }}));
            }})()"""))
            names = [one["text"] for one in texts]
            for name in (f"vehicle {self.away}", "tracking",
                         "environment model", "trajectory planning",
                         "response time, ms", "time, s", "100", "1000"):
                self.assertIn(name, names)
            for i, one in enumerate(texts):
                for other in texts[:i]:
                    self.assertFalse(
                        one["left"] < other["right"]
                        and other["left"] < one["right"]
                        and one["top"] < other["bottom"] - 3
                        and other["top"] < one["bottom"] - 3,
                        f"{one['text']} on {other['text']}")
            self.assertEqual(page.errors, [])

    def test_a_phone_need_not_scroll_sideways(self):
        with Browser() as page:
            self.opened(page, 375)
            self.assertLessEqual(
                page.run("document.documentElement.scrollWidth"), 375)

    def test_all_vehicles_have_three_strips_under_the_map(self):
        with Browser() as page:
            self.opened(page)
            self.assertIn("tracking, environment_model, trajectory_planning",
                          page.run("document.querySelector('.player')"
                                   ".innerText"))


class Comparison(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.folders = [run("never", "--set", "policies.lodm=never"),
                       run("seven", "--seed", "7")]
        cls.file = os.path.join(WORK, "both.html")
        sofof("report", *cls.folders, "-o", cls.file)

    def test_two_maps_share_a_clock(self):
        with Browser() as page:
            page.open(self.file)
            page.run("sofof.ready")
            maps = page.run("""(sofof.players[0].clock.seek(12),
                sofof.players[0].vehicles().map(one => one.length))""")
            self.assertEqual(maps, [6, 6])
            self.assertEqual(page.run("sofof.players.length"), 1)
            self.assertEqual(page.errors, [])

    def test_key_figures_of_both_stand_beside_their_difference(self):
        with Browser() as page:
            page.open(self.file)
            page.run("sofof.ready")
            heads = page.run("""[...document.querySelectorAll("table")]
                .slice(0, 2).map(table => [...table.querySelectorAll("th")]
                    .map(one => one.textContent))""")
            self.assertEqual(heads, [
                ["option", "never", "seven"],
                ["figure", "never", "seven", "difference"]])

    def test_what_differs_comes_first_and_equal_rows_when_asked(self):
        with Browser() as page:
            page.open(self.file)
            page.run("sofof.ready")
            self.assertEqual(
                page.run("document.querySelector('h2').textContent"),
                "What differs")
            before = page.run("document.querySelectorAll('tr').length")
            page.run("""[...document.querySelectorAll(".more")].forEach(
                one => one.click())""")
            self.assertGreater(
                page.run("document.querySelectorAll('tr').length"), before)
            self.assertGreater(
                page.run("document.querySelectorAll('tr.same').length"), 2)


if __name__ == "__main__":
    SOFOF = sys.argv.pop(1)
    if not program():
        print("chromium is not installed: nobody opens a report.")
        sys.exit(SKIPPED)
    WORK = tempfile.mkdtemp(prefix="sofof_report_")
    try:
        unittest.main()
    finally:
        shutil.rmtree(WORK)
