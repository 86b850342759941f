"""What a run of sofof drive wrote down, as far as faults are judged by it; for
tests/acceptance/faults.

All times are those of the run, s, whose time 0 is `zero`, a time of day. Of
trajectory_planning only. The last line of a file of a killed run, cut, is left
out.
"""
import bisect
import csv
import json
import os
import re
from collections import defaultdict

SERVICE = "trajectory_planning"
FRESH_S = 0.2    # max_latency + max_interarrival + period, as SOFOF has it
TRACK_S = 0.02
FILE_TIME_S = 0.01  # the time of a file is that of the kernel's last tick


def lines(folder, name):
    try:
        with open(os.path.join(folder, name), newline="") as file:
            return [line for line in file if line.endswith("\n")]
    except FileNotFoundError:
        return []


class Silence:
    """A time without a result that was used: from one to the next, or to the
    first own plan."""

    def __init__(self, station, begin, end, is_way_back):
        self.station, self.begin, self.end = station, begin, end
        self.is_way_back = is_way_back

    def length_ms(self, stops=()):
        """@param stops  When the car was stopped: (begin, continuation)s. It
        counts from its continuation."""
        return 1e3 * (self.end - self.counts_from(stops))

    def counts_from(self, stops):
        return max([self.begin, *(
            min(on, self.end) for begin, on in stops
            if begin < self.end and on < self.end + FILE_TIME_S)])


class Drive:
    def __init__(self, folder):
        self.folder = folder
        self.zero = os.stat(os.path.join(folder, "config.toml")).st_mtime
        self._read_results()
        self._read_events()
        self.tracks = defaultdict(list)
        for row in csv.DictReader(lines(folder, "tracks.csv")):
            self.tracks[int(row["station"])].append(
                (float(row["t_s"]), float(row["plan_age_ms"]) / 1e3))

    def _read_results(self):
        self.used, self.too_old = defaultdict(list), 0
        for row in csv.DictReader(lines(self.folder, "cycles.csv")):
            if row["service"] == SERVICE and row["used"] == "1":
                self.used[int(row["station"])].append(float(row["received_s"]))
                self.too_old += (float(row["latency_ms"]) > 50
                                 or float(row["input_age_ms"]) > 500)
        for times in self.used.values():
            times.sort()

    def _read_events(self):
        """Of each station: when it was planned for, [begin, end), and when its
        own plans came into use."""
        self.planned_for, self.own = defaultdict(list), defaultdict(list)
        self.events = [json.loads(x) for x in lines(self.folder, "events.jsonl")]
        for event in self.events:
            if event["service"] != SERVICE:
                continue
            is_remote = event["detail"].startswith("remote")
            of = self.planned_for[event["station"]]
            if event["what"] == "switch":
                if of and of[-1][1] == float("inf"):
                    of[-1][1] = event["t_s"]
                if is_remote:
                    of.append([event["t_s"], float("inf")])
            elif event["what"] == "plan_switch" and not is_remote:
                self.own[event["station"]].append(event["t_s"])

    def told(self):
        """Its own figures: s without a fresh plan, collisions. Of a run whose disk
        was full they are on the console alone; of one that was killed, nowhere."""
        try:
            with open(os.path.join(self.folder, "summary.json")) as file:
                safety = json.load(file)["safety"]
            return safety["without_fresh_plan_s"], safety["collisions"]
        except FileNotFoundError:
            with open(f"{self.folder}.log") as file:
                found = re.search(r"without a fresh plan +([\d.]+) s[^$]*?"
                                  r"collisions +(\d+)", file.read())
            return (float(found[1]), int(found[2])) if found else None

    def last_written_s(self, station):
        """Of its track; its results; infinity where none were due."""
        track = self.tracks[station][-1][0] if self.tracks[station] else 0.0
        of = self.planned_for[station]
        if not of or of[-1][1] != float("inf"):
            return track, float("inf")
        return track, self.used[station][-1]

    def holes(self):
        """Steps of tracks that are missing between others."""
        return sum(later[0] - earlier[0] > 1.5 * TRACK_S
                   for rows in self.tracks.values()
                   for earlier, later in zip(rows, rows[1:]))

    def silences(self, begin, end):
        """All that overlap a time, with those of own plans that begin in it."""
        for station, times in self.planned_for.items():
            used = self.used[station]
            for since, until in times:
                if until < begin or since > end:
                    continue
                first = bisect.bisect_left(used, max(since, begin)) - 1
                last = bisect.bisect_right(used, min(until, end))
                inside = [t for t in used[max(0, first):last] if t >= since - 0.01]
                for pair in zip(inside, inside[1:]):
                    yield Silence(station, *pair, False)
                if until <= end and inside:
                    own = self._own_after(station, until)
                    yield Silence(station, inside[-1], own, True)

    def _own_after(self, station, until):
        """When its own plan came into use; where it had stopped safely before,
        nothing tells but its age."""
        for t in self.own[station]:
            if t >= until - 0.01:
                return t if t < until + 0.5 else self._fresh_after(station, until)
        return self._fresh_after(station, until)

    def _fresh_after(self, station, until):
        return next((t for t, age in self.tracks[station]
                     if t > until and t - age >= until - 0.01), float("inf"))

    def stations_planned_for(self, at):
        return [station for station, times in self.planned_for.items()
                if any(begin <= at < end for begin, end in times)]

    def again_after(self, station, since):
        """When it was planned for again; infinity if never."""
        return next((begin for begin, _ in self.planned_for[station]
                     if begin >= since), float("inf"))

    def without_plan(self, stops):
        """Times of tracks at which a car's plan was not fresh, though it was not
        stopped: (begin, continuation)s; its plan ages from its continuation on.
        @returns those of cars that had had a plan of their planner before; how
        many there were of others, which had just been started.
        """
        found, starting = [], 0
        for rows in self.tracks.values():
            has_planned = False
            for t, age in rows:
                has_planned = has_planned or t - age > rows[0][0] + TRACK_S
                if any(begin <= t <= on for begin, on in stops):
                    continue
                on = max((on for _, on in stops if on < t), default=-1.0)
                if min(age, t - on) > FRESH_S:
                    if has_planned:
                        found.append(t)
                    else:
                        starting += 1
        return found, starting
