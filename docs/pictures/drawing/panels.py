"""Parts of a picture. Each says how high it is at a width, and draws itself."""
import math

from .drive import circle, corners_of, thinned
from .svg import ALARM, HOUSE, INK, LINE, SERIES, SOFT, STREET, STRIP, short

PLANNING = "trajectory_planning"
CAR_LENGTH, CAR_WIDTH = 4.9, 1.9  # m
OUTLINED = 8  # pixels: shorter ones would be all outline
MARKS_APART = 1.5  # pixels


def color_of(drive, provider):
    names = drive.providers()
    return (SERIES[names.index(provider) % len(SERIES)]
            if provider in names else STRIP)


def nice_step(length, most):
    """A round number of which at most so many fit into a length."""
    least = length / most
    power = 10 ** math.floor(math.log10(least))
    return next(k * power for k in (1, 2, 5, 10) if k * power >= least)


class Map:
    """Streets, houses, areas, and the ways of vehicles by who planned.

    view: (west, south, east, north), m; by default all that is drawn.
    at: the time at which vehicles are shown, s; None: none are.
    window: of the ways that are drawn, s.
    """

    def __init__(self, drive, title="", service=PLANNING, view=None, at=None,
                 window=None, tracks=True, most_height=420, car_scale=None,
                 extra=None, names=False, areas=True):
        self.drive, self.title, self.service = drive, title, service
        self.at, self.tracks, self.extra = at, tracks, extra
        self.window = window or (0.0, drive.until)
        self.most_height, self.car_scale = most_height, car_scale
        self.names, self.areas = names, areas
        self.view = view or self._view()

    def _view(self):
        points = [p for line, _ in self.drive.streets() for p in line]
        for provider in self.drive.config.get("provider", []):
            points += corners_of(provider)
            if provider.get("position_m"):
                points.append(tuple(provider["position_m"]))
        west, east = min(x for x, _ in points), max(x for x, _ in points)
        south, north = min(y for _, y in points), max(y for _, y in points)
        edge = 0.03 * max(east - west, north - south)
        return west - edge, south - edge, east + edge, north + edge

    def height(self, width):
        west, south, east, north = self.view
        wanted = width * (north - south) / (east - west)
        return (20 if self.title else 0) + min(wanted, self.most_height)

    def draw(self, svg, x, y, width, name):
        if self.title:
            svg.text(x, y + 12, self.title, "h")
            y += 20
        height = self.height(width) - (20 if self.title else 0)
        west, south, east, north = self.view
        self.scale = min(width / (east - west), height / (north - south))
        left = x + (width - self.scale * (east - west)) / 2
        top = y + (height - self.scale * (north - south)) / 2
        self.to = lambda u, v: (left + self.scale * (u - west),
                                top + self.scale * (north - v))
        svg.clip(name, x, y, width, height)
        self._ground(svg)
        if self.areas:
            self._areas(svg)
        if self.tracks:
            self._tracks(svg)
        if self.at is not None:
            self._cars(svg)
        if self.extra:
            self.extra(self, svg)
        self._labels(svg)
        svg.end()
        self._bar(svg, x + 4, y + height - 6)

    def line(self, points):
        return [self.to(*p) for p in points]

    def _ground(self, svg):
        for corners in self.drive.houses():
            svg.path(self.line(corners), close=True, style=f"fill:{HOUSE}")
        by_width = {}
        for points, wide in self.drive.streets():
            by_width.setdefault(wide, []).append(
                thinned(self.line(points), 0.2))
        for wide, lines in by_width.items():
            svg.path(lines, stroke=STREET,
                     stroke_width=short(max(2.5, self.scale * wide)))

    def _areas(self, svg):
        for provider in self.drive.config.get("provider", []):
            color = color_of(self.drive, provider["name"])
            if corners := corners_of(provider):
                svg.path(self.line(corners), close=True, stroke=color,
                         stroke_dasharray="4 4", fill_opacity="0.07",
                         style=f"fill:{color}")

    def _tracks(self, svg):
        lines = {}
        begin, end = self.window
        for station, rows in self.drive.tracks.items():
            now, line = None, []
            for row in rows:
                if not begin <= row["t"] <= end:
                    continue
                who = self.drive.who(station, self.service, row["t"])
                here = self.to(row["x"], row["y"])
                if who != now and line:
                    lines.setdefault(now, []).append(line + [here])
                    line = []
                now = who
                line.append(here)
            if line:
                lines.setdefault(now, []).append(line)
        for who in sorted(lines, key=lambda x: (x is not None, str(x))):
            color = color_of(self.drive, who) if who else "#8a9199"
            svg.path([thinned(line, 0.35) for line in lines[who]],
                     stroke=color, stroke_width=2.2 if who else 1.6)

    def _cars(self, svg):
        size = self.car_scale or max(1.0, 13 / (self.scale * CAR_LENGTH))
        by_color = {}
        for station in self.drive.tracks:
            row = self.drive.place(station, self.at)
            if not row:
                continue
            who = self.drive.who(station, self.service, self.at)
            color = color_of(self.drive, who) if who else "#fff"
            by_color.setdefault(color, []).append(self.line(car(row, size)))
            if self.names:
                u, v = self.to(row["x"], row["y"])
                svg.text(u + 7, v - 5, str(station), "o")
        is_large = size * CAR_LENGTH * self.scale >= OUTLINED
        for color, shapes in by_color.items():
            svg.path(shapes, close=True, style=f"fill:{color}",
                     stroke=INK if is_large or color == "#fff" else color)

    def _labels(self, svg):
        for provider in self.drive.config.get("provider", []):
            if not provider.get("position_m"):
                continue
            u, v = self.to(*provider["position_m"])
            color = color_of(self.drive, provider["name"])
            svg.path([(u, v - 5), (u + 5, v), (u, v + 5), (u - 5, v)],
                     close=True, stroke="#fff", style=f"fill:{color}")
            svg.text(u + 8, v - 6, provider["name"], "h o")

    def _bar(self, svg, x, y):
        length = nice_step(32 / self.scale, 1)
        svg.line(x, y, x + self.scale * length, y, stroke=SOFT, stroke_width=2)
        svg.text(x, y - 6, f"{length:g} m", "o")


def car(row, size):
    """Corners of a car, drawn so many times its size; its nose is a point."""
    c, s = math.cos(row["heading"]), math.sin(row["heading"])
    a, b = size * CAR_LENGTH / 2, size * CAR_WIDTH / 2
    shape = ((1.2 * a, 0), (0.5 * a, b), (-a, b), (-a, -b), (0.5 * a, -b))
    return [(row["x"] + c * p - s * q, row["y"] + s * p + c * q)
            for p, q in shape]


class TimeAxis:
    """What panels over time share."""

    def __init__(self, drive, title, window=None):
        self.drive, self.title = drive, title
        self.window = window or (0.0, drive.until)

    def at(self, t):
        begin, end = self.window
        share = (t - begin) / (end - begin)
        return self.left + share * (self.right - self.left)

    def axis(self, svg, top, bottom, ticks=8):
        begin, end = self.window
        step = nice_step(end - begin, ticks)
        if end - begin > 180:  # in minutes
            step = 60 * math.ceil(step / 60)
        k = math.ceil(begin / step)
        while k * step <= end + 1e-9:
            u = self.at(k * step)
            svg.line(u, top, u, bottom, stroke=LINE, stroke_width=1)
            text = (f"{k * step / 60:g}" if step >= 60 else f"{k * step:g}")
            unit = "" if (k + 1) * step <= end else (
                " min" if step >= 60 else " s")
            svg.text(u, bottom + 14, text + unit, "m")
            k += 1


class Strips(TimeAxis):
    """A strip for each vehicle: grey where it planned on board, in its
    provider's colour where that did, a mark where results came too late.

    shades: (begin, end, words) of times that are marked.
    services: several: a narrow strip for each, from top to bottom.
    """

    def __init__(self, drive, title="", services=(PLANNING,), window=None,
                 row_height=None, shades=(), colors=None, stations=None):
        super().__init__(drive, title, window)
        self.services, self.shades, self.colors = services, shades, colors
        self.stations = [x for x in drive.tracks
                         if stations is None or x in stations]
        few = len(self.stations) <= 20
        self.row = row_height or (max(16, 7 * len(services) + 4) if few else 5)
        self.labels = self.row >= 12

    def height(self, _):
        return 20 + self.row * len(self.stations) + 22

    def draw(self, svg, x, y, width, _):
        self.left, self.right = x + (32 if self.labels else 4), x + width - 14
        svg.text(x, y + 12, self.title, "h")
        top = y + 22
        bottom = top + self.row * len(self.stations)
        for begin, end, words in self.shades:
            svg.rect(self.at(begin), top - 2, self.at(end) - self.at(begin),
                     bottom - top + 4, fill=ALARM, fill_opacity="0.09")
            svg.text((self.at(begin) + self.at(end)) / 2, top - 6, words, "m")
        self.axis(svg, top, bottom)
        for k, station in enumerate(self.stations):
            middle = top + self.row * (k + 0.5)
            if self.labels:
                svg.text(x + 26, middle + 4, str(station), "e")
            self._strip(svg, station, middle)

    def _strip(self, svg, station, middle):
        rows = self.drive.tracks[station]
        begin = max(rows[0]["t"], self.window[0])
        end = min(rows[-1]["t"], self.window[1])
        count = len(self.services)
        high = min(8, 0.6 * self.row) if count == 1 else 6
        for k, service in enumerate(self.services):
            at = middle + (k - (count - 1) / 2) * (high + 1)
            self._bars(svg, at, [(begin, end)], STRIP, high / 2)
            bars = {}
            key = station, service
            for first, last, who in self.drive.spans.get(key, []):
                first, last = max(first, begin), min(last, end)
                if last > first:
                    color = (self.colors[k] if self.colors
                             else color_of(self.drive, who))
                    bars.setdefault(color, []).append((first, last))
            for color, spans in bars.items():
                self._bars(svg, at, spans, color, high)
            self._marks(svg, at, high / 2 + 1, sorted(
                t for who, what, t in self.drive.faults
                if (who, what) == (station, service) and begin <= t <= end))

    def _bars(self, svg, at, spans, color, high):
        svg.path([[(self.at(first), at), (self.at(last), at)]
                  for first, last in spans], stroke=color,
                 stroke_width=short(high), style="stroke-linecap:butt")

    def _marks(self, svg, at, half, times):
        """Those that would lie on each other are one."""
        lines, last = [], None
        for t in times:
            apart = MARKS_APART if self.labels else 2 * MARKS_APART
            if last is None or self.at(t) - last >= apart:
                last = self.at(t)
                lines.append([(last, at - half), (last, at + half)])
        svg.path(lines or [[]], stroke=ALARM, stroke_width=1.2)


class Curves(TimeAxis):
    """A quantity of vehicles over time.

    of: of a row of tracks, its value.
    drives: {words: (drive, color, stations)}.
    """

    def __init__(self, title, unit, of, drives, window=None, height=160,
                 zero=True, lines=()):
        first = next(iter(drives.values()))[0]
        super().__init__(first, title, window)
        self.unit, self.of, self.drives = unit, of, drives
        self.high, self.zero, self.lines = height, zero, lines

    def height(self, _):
        return self.high + 44

    def draw(self, svg, x, y, width, name):
        self.left, self.right = x + 32, x + width - 14
        svg.text(x, y + 12, self.title, "h")
        top, bottom = y + 24, y + 24 + self.high
        rows = [(words, color, drive.tracks[station])
                for words, (drive, color, stations) in self.drives.items()
                for station in stations if station in drive.tracks]
        values = [self.of(row) for _, _, all_rows in rows for row in all_rows
                  if self.window[0] <= row["t"] <= self.window[1]]
        low, high = min(values), max(values)
        if self.zero:
            low, high = min(0.0, low), max(0.0, high)
        step = nice_step(high - low, 5)
        low, high = step * math.floor(low / step), step * math.ceil(high / step)

        def up(value):
            return bottom - (value - low) / (high - low) * self.high

        self.axis(svg, top, bottom)
        for k in range(round((high - low) / step) + 1):
            value = low + k * step
            svg.line(self.left, up(value), self.right, up(value), stroke=LINE)
            svg.text(x + 26, up(value) + 4, f"{value:g}", "e")
        for value, words in self.lines:
            svg.line(self.left, up(value), self.right, up(value), stroke=SOFT,
                     stroke_dasharray="3 4")
            svg.text(self.right, up(value) - 5, words, "e o")
        svg.clip(name, self.left, top - 2, self.right - self.left,
                 self.high + 4)
        for _, color, all_rows in rows:
            line = [(self.at(row["t"]), up(self.of(row))) for row in all_rows]
            svg.path(thinned(line, 0.3), stroke=color, stroke_width=1.8)
        svg.end()
        svg.text(self.right, y + 12, self.unit, "e")


class Legend:
    """Names of colours: [(color, words, "bar", "line" or "mark")]."""

    def __init__(self, entries):
        self.entries = entries

    def height(self, _):
        return 14

    def draw(self, svg, x, y, _width, _name):
        for color, words, kind in self.entries:
            if kind == "mark":
                svg.line(x + 7, y + 1, x + 7, y + 11, stroke=color,
                         stroke_width=1.6)
            else:
                high = 8 if kind == "bar" else 3
                svg.rect(x, y + 6 - high / 2, 14, high, fill=color)
            svg.text(x + 19, y + 10, words)
            x += 19 + 6.8 * len(words) + 16


__all__ = ["Curves", "Legend", "Map", "Strips", "circle"]
