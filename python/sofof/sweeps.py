"""What sweeps and benches write, as data frames."""
import functools
import os
import pathlib
from typing import TYPE_CHECKING

from .program import SofofError
from .results import Results, load

if TYPE_CHECKING:
    import pandas

# Columns of every sweep's table; the others are axes before, figures behind.
_POINT_TYPES = {"point": "int64", "seed": "int64", "status": "category",
                "run": "string"}
_BOARD_TYPES = {"scenario": "category", "place": "int64", "entrant": "string",
                "lodm": "string", "codm": "string", "status": "category",
                "runs": "int64", "unsafe": "int64", "failed": "int64",
                "tied": "int64"}


def _read(file: pathlib.Path, dtypes: dict[str, str]) -> "pandas.DataFrame":
    import pandas

    if not file.is_file():
        raise SofofError(f"{file}: there is no such file.")
    names = pandas.read_csv(file, nrows=0).columns
    return pandas.read_csv(file, keep_default_na=False, na_values=[""],
                           dtype={k: v for k, v in dtypes.items()
                                  if k in names})


class Sweep:
    """The folder of a sweep.

    Attributes:
        folder: where it is.
        name: of its table.
    """

    def __init__(self, folder: str | os.PathLike[str], name: str):
        self.folder = pathlib.Path(folder)
        self.name = name

    @functools.cached_property
    def table(self) -> "pandas.DataFrame":
        """A line for each point: axes, `seed`, `status`, `run`, and the figures
        of its summary under their paths, "latency_ms.mean"."""
        return _read(self.folder / f"{self.name}.csv", _POINT_TYPES)

    @property
    def axes(self) -> list[str]:
        """Names of the columns that were varied."""
        names = list(self.table.columns)
        return names[1:names.index("seed")]

    def run(self, point: int) -> Results:
        """The results of a point.

        Raises:
            KeyError: there is no such point.
        """
        row = self.table.set_index("point").loc[point]
        return load(self.folder / "runs" / row["run"])


class Leaderboard:
    """The folder of a bench.

    Attributes:
        folder: where it is.
    """

    def __init__(self, folder: str | os.PathLike[str]):
        self.folder = pathlib.Path(folder)

    @functools.cached_property
    def table(self) -> "pandas.DataFrame":
        """leaderboard.csv: a line for each entrant in all scenarios together
        and in each one."""
        table = _read(self.folder / "leaderboard.csv", _BOARD_TYPES)
        return table.astype({"tied": "bool"})

    def of(self, scenario: str = "all") -> "pandas.DataFrame":
        """The lines of one scenario, by place."""
        lines = self.table[self.table["scenario"] == scenario]
        if lines.empty:
            raise SofofError(f"{self.folder} has no scenario {scenario!r}.")
        return lines.sort_values("place", kind="stable")
