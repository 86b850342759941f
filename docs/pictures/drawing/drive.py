"""A results folder as pictures need it."""
import csv
import json
import math
import pathlib
import tomllib

VIOLATIONS = ("violation",)


class Drive:
    """What a run has written.

    config: config.toml; tracks: rows by station; spans: by station and service
    (begin, end, provider) of the time for which a provider's results were used.
    """

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.config = tomllib.loads((self.folder / "config.toml").read_text())
        self.map = self._map()
        self.tracks = self._tracks()
        last = max((rows[-1]["t"] for rows in self.tracks.values()), default=0)
        self.until = float(math.ceil(last - 1e-6))
        self.spans, self.faults = {}, []
        self._read_events()

    def _map(self):
        file = self.folder / "map.toml"
        return tomllib.loads(file.read_text()) if file.exists() else {}

    def _tracks(self):
        by_station = {}
        with open(self.folder / "tracks.csv", newline="") as file:
            for row in csv.DictReader(file):
                by_station.setdefault(int(row["station"]), []).append({
                    "t": float(row["t_s"]), "x": float(row["x_m"]),
                    "y": float(row["y_m"]), "s": float(row["s_m"]),
                    "heading": float(row["heading_rad"]),
                    "speed": float(row["speed_mps"]),
                    "remote": row["source"] == "remote"})
        return dict(sorted(by_station.items()))

    def _read_events(self):
        open_now = {}
        with open(self.folder / "events.jsonl") as file:
            for line in file:
                event = json.loads(line)
                key = event["station"], event["service"]
                if event["what"] == "switch":
                    self._close(open_now, key, event["t_s"])
                    if event["detail"].startswith("remote"):
                        open_now[key] = event["t_s"], event["provider"]
                elif event["what"] in VIOLATIONS:
                    self.faults.append((*key, event["t_s"]))
        for key in list(open_now):
            self._close(open_now, key, self.until)

    def _close(self, open_now, key, at):
        if key in open_now:
            begin, provider = open_now.pop(key)
            self.spans.setdefault(key, []).append((begin, at, provider))

    def providers(self):
        """Names in the scenario's order; those on board come last."""
        names = [x["name"] for x in self.config.get("provider", [])]
        served = {span[2] for spans in self.spans.values() for span in spans}
        return names + sorted(served - set(names))

    def who(self, station, service, at):
        """The provider whose results are used then, or None."""
        for begin, end, provider in self.spans.get((station, service), []):
            if begin <= at < end:
                return provider
        return None

    def place(self, station, at):
        """The row of a vehicle at a time; None where it is not on the road."""
        rows = self.tracks.get(station, [])
        best = min(rows, key=lambda row: abs(row["t"] - at), default=None)
        return best if best and abs(best["t"] - at) < 1.5 else None

    def streets(self):
        """Middles of lanes with their widths, m; of a grid, of its streets."""
        grid = self.config.get("street_grid")
        if grid:
            return grid_streets(grid)
        return [([tuple(p) for p in lane["points_m"]],
                 2 * lane.get("half_width_m", 1.75))
                for lane in self.map.get("lane", [])]

    def houses(self):
        return [x["corners_m"] for x in self.map.get("building", [])
                if "corners_m" in x]


def grid_streets(grid):
    columns, rows = grid.get("columns", 16), grid.get("rows", 16)
    block = grid.get("block_m", 150.0)
    wide, high = block * (columns - 1), block * (rows - 1)
    return ([([(0.0, block * k), (wide, block * k)], 7.0) for k in range(rows)]
            + [([(block * k, 0.0), (block * k, high)], 7.0)
               for k in range(columns)])


def corners_of(provider):
    """The corners of a provider's area, m; none if it has none of its own."""
    if provider.get("area_m"):
        return [tuple(x) for x in provider["area_m"]]
    if not provider.get("position_m") or not provider.get("area_radius_m"):
        return []
    x, y = provider["position_m"]
    return circle(x, y, provider["area_radius_m"])


def circle(x, y, radius, corners=72):
    return [(x + radius * math.cos(2 * math.pi * k / corners),
             y + radius * math.sin(2 * math.pi * k / corners))
            for k in range(corners)]


def thinned(points, tolerance):
    """The points without which the line would be off by more than that
    (Douglas and Peucker 1973)."""
    if len(points) < 3:
        return points
    keep, todo = {0, len(points) - 1}, [(0, len(points) - 1)]
    while todo:
        first, last = todo.pop()
        (ax, ay), (bx, by) = points[first], points[last]
        length = math.hypot(bx - ax, by - ay)
        worst, at = tolerance, None
        for k in range(first + 1, last):
            px, py = points[k]
            off = (abs((bx - ax) * (py - ay) - (by - ay) * (px - ax)) / length
                   if length > 1e-9 else math.hypot(px - ax, py - ay))
            if off > worst:
                worst, at = off, k
        if at is not None:
            keep.add(at)
            todo += [(first, at), (at, last)]
    return [points[k] for k in sorted(keep)]
