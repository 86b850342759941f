"""The results of a run as data frames."""
import functools
import io
import json
import os
import pathlib
import tomllib
from typing import TYPE_CHECKING, Any

from . import tables
from .program import SofofError

if TYPE_CHECKING:
    import pandas

# What safe runs have none of: figures of `safety` in the summary.
SAFETY = ("without_fresh_plan_s", "collisions", "off_road_s")


def load(folder: str | os.PathLike[str]) -> "Results":
    """The results of a run.

    Args:
        folder: that `sofof run`, `provide`, `drive` or a sweep wrote.

    Raises:
        SofofError: it is none.
    """
    return Results(folder)


class Results:
    """The results folder of a run. Tables are read when they are first asked
    for, and kept: each is an attribute, `results.cycles`, with the columns of
    docs/results.md, and units in `frame.attrs["units"]`.

    A folder without summary.json is of a run that was killed: then a last line
    that was cut is left out, and `summary` is empty.
    """

    def __init__(self, folder: str | os.PathLike[str]):
        self.folder = pathlib.Path(folder)
        if not (self.folder / "config.toml").is_file():
            raise SofofError(f"{folder} is no results folder: it has no "
                             "config.toml.")

    def __repr__(self) -> str:
        return f"Results({str(self.folder)!r})"

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """summary.json; empty for a run that was killed."""
        file = self.folder / "summary.json"
        return json.loads(file.read_text("utf-8")) if file.is_file() else {}

    @functools.cached_property
    def config(self) -> dict[str, Any]:
        """The effective configuration."""
        return tomllib.loads((self.folder / "config.toml").read_text("utf-8"))

    @property
    def finished(self) -> bool:
        """Whether the run came to its end."""
        return bool(self.summary)

    @property
    def safe(self) -> bool:
        """Whether nobody was without a fresh plan, left the road or touched
        anybody. False where the run did not come to its end."""
        safety = self.summary.get("safety", {})
        return self.finished and not any(safety[x] for x in SAFETY)

    def tables(self) -> list[str]:
        """Names of the tables that this run wrote."""
        return [x for x in tables.TABLES
                if (self.folder / tables.FILES[x]).is_file()]

    def table(self, name: str) -> "pandas.DataFrame":
        """A table, e.g. "cycles".

        Raises:
            KeyError: there is no such table.
            SofofError: this run did not write it, or it is broken.
        """
        if name not in self.__dict__:
            self.__dict__[name] = self._read(name)
        return self.__dict__[name]

    def __getattr__(self, name: str) -> "pandas.DataFrame":
        if name not in tables.TABLES:
            raise AttributeError(f"Results have no {name!r}; tables are "
                                 f"{', '.join(tables.TABLES)}.")
        return self.table(name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *tables.TABLES]

    def _read(self, name: str) -> "pandas.DataFrame":
        columns = tables.TABLES[name]
        file = self.folder / tables.FILES[name]
        if not file.is_file():
            raise SofofError(f"{self.folder} has no {file.name}: this run "
                             "wrote none.")
        text = file.read_bytes()
        if not self.finished:
            text = text[:text.rfind(b"\n") + 1]
        read = _of_json_lines if file.suffix == ".jsonl" else _of_csv
        try:
            frame = read(text, columns)
        except (ValueError, KeyError) as e:
            raise SofofError(f"{file}: {e}") from e
        frame.attrs["units"] = {x.name: x.unit for x in columns
                                if x.unit and x.name in frame}
        return frame


def _of_csv(text: bytes,
            columns: tuple[tables.Column, ...]) -> "pandas.DataFrame":
    import pandas

    if not text:
        return _typed(pandas.DataFrame(columns=[x.name for x in columns]),
                      columns)
    # 1 and 0 come as numbers; nothing but an empty field is no value.
    dtypes = {x.name: "int64" if x.dtype == "bool" else x.dtype
              for x in columns}
    frame = pandas.read_csv(io.BytesIO(text), dtype=dtypes, na_values=[""],
                            keep_default_na=False, encoding="utf-8")
    return _typed(frame, columns)


def _of_json_lines(text: bytes,
                   columns: tuple[tables.Column, ...]) -> "pandas.DataFrame":
    import pandas

    rows = [json.loads(line) for line in text.splitlines()]
    frame = pandas.DataFrame(rows, columns=[x.name for x in columns])
    names = [x.name for x in columns if x.dtype in ("category", "string")]
    frame[names] = frame[names].replace({"": None})
    return _typed(frame, columns)


def _typed(frame: "pandas.DataFrame",
           columns: tuple[tables.Column, ...]) -> "pandas.DataFrame":
    """With the types of the columns; a column that a newer or older version
    has more or less is left alone."""
    return frame.astype({x.name: x.dtype for x in columns if x.name in frame})
