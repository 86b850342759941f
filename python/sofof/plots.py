"""Plots of runs, sweeps and benches, with matplotlib. Each draws on the axes
given, or on new ones, and returns them."""
import pathlib
import tomllib
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from .program import SofofError
from .results import Results
from .sweeps import Leaderboard, Sweep

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ON_BOARD = "#8a8f98"
REMOTE = ("#c0392b", "#2471a3", "#229954", "#b9770e", "#7d3c98", "#148f77")
ENOUGH_RUNS = 5  # of a point, for an interval


def _axes(ax: "Axes | None") -> "Axes":
    if ax is not None:
        return ax
    import matplotlib.pyplot

    return matplotlib.pyplot.subplots()[1]


def _named(results: Results | Mapping[str, Results] | Sequence[Results]
           ) -> dict[str, Results]:
    """By the words of the legend."""
    if isinstance(results, Results):
        return {"": results}
    if isinstance(results, Mapping):
        return dict(results)
    return {x.folder.name: x for x in results}


def t_off(results: Results | Mapping[str, Results] | Sequence[Results] | Sweep,
          service: str = "trajectory_planning", axis: str | None = None,
          ax: "Axes | None" = None) -> "Axes":
    """How long offloadings lasted.

    Of runs: of each episode of the vehicles, when it began and how long it
    lasted, a cross where the end of the drive cut it off. Of a sweep: the mean
    over an axis, a curve for each combination of the others, with 95 %
    intervals where a point has five runs or more.

    Args:
        results: one run, several (a dict says how they are called), or a sweep.
        service: of runs, whose episodes.
        axis: of a sweep; by default its first one.
    """
    ax = _axes(ax)
    if isinstance(results, Sweep):
        _t_off_of_sweep(results, axis or results.axes[0], ax)
        return ax
    named = _named(results)
    for color, (name, one) in zip(_colors(len(named)), named.items()):
        all_of_both = one.episodes
        x = all_of_both[(all_of_both["side"] == "requester")
                        & (all_of_both["service"] == service)
                        & all_of_both["t_off_s"].notna()]
        cut = x["reason"] == "shutdown"
        ax.plot(x["first_data_s"][~cut], x["t_off_s"][~cut], "o", color=color,
                markersize=4, label=name or None)
        ax.plot(x["first_data_s"][cut], x["t_off_s"][cut], "x", color=color,
                markersize=5)
    ax.set_xlabel("offloaded at, s")
    ax.set_ylabel(r"$t_\mathrm{off}$, s")
    ax.set_ylim(0, 1.1 * ax.get_ylim()[1])
    _legend(ax)
    return ax


def _colors(count: int) -> list[str]:
    return [REMOTE[k % len(REMOTE)] for k in range(count)]


def _legend(ax: "Axes") -> None:
    if ax.get_legend_handles_labels()[1]:
        ax.legend(frameon=False)


def _t_off_of_sweep(sweep: Sweep, axis: str, ax: "Axes") -> None:
    table = sweep.table[sweep.table["status"] != "failed"]
    if axis not in sweep.axes:
        raise SofofError(f"{sweep.folder} varies {', '.join(sweep.axes)}, and "
                         f"no {axis!r}.")
    others = [x for x in sweep.axes if x != axis]
    by = others[0] if len(others) == 1 else others
    curves = table.groupby(by, sort=False) if others else [("", table)]
    for name, rows in curves:
        points = rows.groupby(axis, sort=False)["t_off_s.mean"]
        means, widths = points.mean(), points.apply(_half_interval)
        ax.errorbar(_numbers(means.index), means.to_numpy(),
                    yerr=widths.to_numpy(), marker="o", markersize=4,
                    capsize=2, label=_words(name))
    ax.set_xlabel(axis)
    ax.set_ylabel(r"mean $t_\mathrm{off}$, s")
    ax.set_ylim(0, 1.1 * ax.get_ylim()[1])
    _legend(ax)


def _words(name: Any) -> str | None:
    words = name if isinstance(name, tuple) else (name,)
    return ", ".join(map(str, words)) or None


def _half_interval(values: Any) -> float:
    """Half the 95 % interval of the mean; nothing of few runs."""
    values = values.dropna()
    if len(values) < ENOUGH_RUNS:
        return 0.0
    # Student's t for 4, 5, … degrees of freedom, 97.5 %; later the normal one.
    table = (2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179,
             2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093)
    place = len(values) - ENOUGH_RUNS
    t = table[place] if place < len(table) else 1.96
    return t * values.std() / len(values) ** 0.5


def _numbers(values: Any) -> list[Any]:
    """Numbers of "60ms" and the like, if all are of one unit; else as they
    are."""
    import re

    found = [re.fullmatch(r"([-+.0-9e]+)\s*([a-z]*)", str(x)) for x in values]
    numbers = [x for x in found if x]
    if len(numbers) < len(found) or len({x[2] for x in numbers}) > 1:
        return [str(x) for x in values]
    return [float(x[1]) for x in numbers]


def latency_tail(results: Results | Mapping[str, Results] | Sequence[Results],
                 service: str = "trajectory_planning",
                 ax: "Axes | None" = None) -> "Axes":
    """The share of results that took longer, 1 - F, on a logarithmic axis, and
    the limit of the first run. Where no cycles are recorded, by bins of 0.1 ms.
    """
    ax = _axes(ax)
    named = _named(results)
    for color, (name, one) in zip(_colors(len(named)), named.items()):
        times_ms, share = _tail(one, service)
        ax.step(times_ms, share, where="post", color=color, linewidth=1.2,
                label=name or None)
    limit_ms = _limit_ms(next(iter(named.values())), service)
    if limit_ms is not None:
        ax.axvline(limit_ms, color="black", linewidth=0.8, linestyle=":")
    ax.set_yscale("log")
    ax.set_ylim(top=1.2)
    ax.set_xlim(left=0)
    ax.set_xlabel("latency, ms")
    ax.set_ylabel("1 − F")
    _legend(ax)
    return ax


def _tail(one: Results, service: str) -> tuple[Any, Any]:
    import numpy

    if "cycles" in one.tables():
        x = one.cycles
        times_ms = numpy.sort(x["latency_ms"][x["service"] == service])
        counts = numpy.ones(len(times_ms))
    else:
        x = one.distributions
        x = x[(x["service"] == service) & (x["figure"] == "latency")]
        times_ms, counts = x["up_to_ms"].to_numpy(), x["count"].to_numpy()
    if len(times_ms) == 0:
        raise SofofError(f"{one.folder} has no results of {service!r}.")
    # The last value has nobody beyond: it is where the curve ends.
    longer = counts.sum() - numpy.cumsum(counts)
    return times_ms, (longer + 0.5) / counts.sum()


def _limit_ms(one: Results, service: str) -> float | None:
    import re

    unit_ms = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3, "min": 6e4,
               "h": 3.6e6}
    for x in one.config.get("service", []):
        found = re.fullmatch(r"([.0-9]+)([a-z]+)",
                             str(x.get("max_latency", "")))
        if x.get("name") == service and found:
            return float(found[1]) * unit_ms[found[2]]
    return None


def map_with_tracks(results: Results, ax: "Axes | None" = None) -> "Axes":
    """Lanes, areas of providers, and the ways of vehicles: grey where they
    planned on board, in a colour where a provider did."""
    ax = _axes(ax)
    for lane in _lanes(results):
        ax.plot([p[0] for p in lane], [p[1] for p in lane], color="#d5d8dc",
                linewidth=4, solid_capstyle="round", zorder=1)
    for color, x in zip(_colors(99), results.config.get("provider", [])):
        _area(x, color, ax)
    tracks = results.tracks
    for source, color, z in (("local", ON_BOARD, 2), ("remote", REMOTE[0], 3)):
        for _, way in tracks.groupby("station"):
            here = (way["source"] == source).to_numpy()
            ax.plot(way["x_m"].where(here), way["y_m"].where(here),
                    color=color, linewidth=1.6, zorder=z)
    ax.set_aspect("equal")
    ax.set_xlabel("east, m")
    ax.set_ylabel("north, m")
    return ax


def _lanes(results: Results) -> list[list[list[float]]]:
    file = results.folder / "map.toml"
    if not file.is_file():
        return []
    text = tomllib.loads(pathlib.Path(file).read_text("utf-8"))
    return [x["points_m"] for x in text.get("lane", []) if "points_m" in x]


def _area(provider: Mapping[str, Any], color: str, ax: "Axes") -> None:
    import matplotlib.patches

    style = {"fill": True, "facecolor": color, "alpha": 0.08, "zorder": 0}
    if provider.get("area_m"):
        ax.add_patch(matplotlib.patches.Polygon(provider["area_m"], **style))
    elif provider.get("area_radius_m") and provider.get("position_m"):
        ax.add_patch(matplotlib.patches.Circle(
            provider["position_m"], provider["area_radius_m"], **style))
    if provider.get("position_m"):
        ax.plot(*provider["position_m"], "^", color=color, markersize=6)


def leaderboard(board: Leaderboard, scenario: str = "all",
                figure: str = "score", ax: "Axes | None" = None) -> "Axes":
    """A figure of all who took part, best place on top, with 95 % intervals;
    hollow: below the line.

    Args:
        board: of a bench.
        scenario: one of it; by default all together.
        figure: a column of leaderboard.csv.
    """
    ax = _axes(ax)
    rows = board.of(scenario)
    if figure not in rows:
        raise SofofError(f"{board.folder}: leaderboard.csv has no column "
                         f"{figure!r}.")
    for place, (_, row) in enumerate(rows.iterrows()):
        ranked = row["status"] == "ranked"
        low, high = row.get(f"{figure}_low"), row.get(f"{figure}_high")
        if low == low and high == high:
            ax.plot([low, high], [place, place], color=REMOTE[1], linewidth=1.2)
        ax.plot(row[figure], place, "o", color=REMOTE[1], markersize=4.5,
                markerfacecolor=REMOTE[1] if ranked else "white")
    ax.set_yticks(range(len(rows)), list(rows["entrant"]))
    ax.set_ylim(len(rows) - 0.5, -0.5)
    ax.set_xlabel(figure.replace("_", " "))
    return ax
