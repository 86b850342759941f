"""Runs of the program: one, a sweep, a bench."""
import os
import pathlib
import shlex
import shutil
import sys
import tempfile
from collections.abc import Iterable, Mapping, Sequence

from . import program
from .results import Results, load
from .sweeps import Leaderboard, Sweep

Path = str | os.PathLike[str]
UNSAFE = 1  # an exit code: of a run that failed, too


def _existing(scenario: Path) -> str:
    """A scenario's file as an absolute path; a name stays a name."""
    path = pathlib.Path(scenario)
    return str(path.resolve()) if path.is_file() else str(scenario)


def run(scenario: Path, set: Mapping[str, object] | None = None,
        seed: int | None = None, duration: str | float | None = None,
        out: Path | None = None, force: bool = False,
        options: Sequence[str] = ()) -> Results:
    """Drives a scenario.

    Args:
        scenario: its file, or its name in a checkout ("ulm_lehr").
        set: options to change, by their paths:
            {"policies.lodm": "nearest", "fleet.0.count": 4}.
        seed: of all randomness; by default that of the file.
        duration: of the run, "60s", or in seconds; by default that of the file.
        out: folder of the results; by default a new one in results/.
        force: whether results that are in `out` already are replaced.
        options: further words of the command line, ["--realtime"].

    Returns:
        the results; look at `safe`.

    Raises:
        SofofError: the scenario is wrong, or the run failed.
    """
    folder = pathlib.Path(out) if out else _new_folder(scenario, seed)
    words = ["run", _existing(scenario), "--quiet", "--out", str(folder)]
    if seed is not None:
        words.append(f"--seed={seed}")
    if duration is not None:
        words.append(f"--duration={_length(duration)}")
    if force:
        words.append("--force")
    words += [*program.settings(set or {}), *options]
    _call(words, folder / "summary.json")
    return load(folder)


def _call(words: Sequence[str], written: pathlib.Path) -> None:
    """Runs the program; that something was unsafe is no error, if it came to
    its end: then it has written a file anew."""
    before = _stamp(written)
    try:
        program.call(words)
    except program.SofofError as e:
        if e.exit_code != UNSAFE or _stamp(written) in (None, before):
            raise


def _stamp(file: pathlib.Path) -> tuple[int, int] | None:
    """Which file is there, by its inode and time."""
    try:
        at = file.stat()
    except FileNotFoundError:
        return None
    return at.st_ino, at.st_mtime_ns


def _length(duration: str | float) -> str:
    return duration if isinstance(duration, str) else f"{duration!r}s"


def _new_folder(scenario: Path, seed: int | None) -> pathlib.Path:
    """results/NAME-SEED, with a number behind it if that exists."""
    name = pathlib.Path(scenario).stem
    stem = f"{name}-{seed}" if seed is not None else name
    folder, count = pathlib.Path("results") / stem, 1
    while folder.exists():
        count += 1
        folder = pathlib.Path("results") / f"{stem}-{count}"
    return folder


def sweep(scenario: Path, axes: Mapping[str, Sequence[object]] | None = None,
          seeds: int | Sequence[int] = 1,
          set: Mapping[str, object] | None = None, out: Path | None = None,
          name: str = "sweep", jobs: int | None = None) -> Sweep:
    """Runs a scenario for each combination of values and seeds; what was run
    before in the same folder is not run again (docs/sweeps.md).

    Args:
        scenario: its file; without `axes` and `set` it may be a sweep file.
        axes: values by the path of an option:
            {"service.trajectory_planning.max_interarrival": ["60ms", "100ms"]}.
        seeds: which, or how many, from 1 on.
        set: options to change in all runs.
        out: folder of all results; by default results/NAME.
        name: of the table.
        jobs: runs at a time; by default as many as there are cores.

    Raises:
        SofofError: the input is wrong; what was finished is kept. A point that
            failed is none: its `status` says so.
    """
    is_sweep_file = axes is None and not set and _has_scenario(scenario)
    if is_sweep_file:
        file = pathlib.Path(scenario)
        name = _sweep_name(file)
    folder = pathlib.Path(out or pathlib.Path("results") / name)
    words = ["--quiet", "--out", str(folder)]
    if jobs is not None:
        words.append(f"-j{jobs}")
    if is_sweep_file:
        _call(["sweep", str(file), *words], folder / f"{name}.csv")
        return Sweep(folder, name)
    with tempfile.TemporaryDirectory(prefix="sofof_") as at:
        file = pathlib.Path(at) / f"{name}.toml"
        file.write_text(_sweep_file(name, scenario, axes or {}, seeds,
                                    set or {}))
        _call(["sweep", str(file), *words], folder / f"{name}.csv")
    return Sweep(folder, name)


def _toml_of(file: Path) -> dict[str, object]:
    import tomllib

    try:
        return tomllib.loads(pathlib.Path(file).read_text("utf-8"))
    except (OSError, ValueError):
        return {}  # the program says what is wrong with it


def _has_scenario(file: Path) -> bool:
    return isinstance(_toml_of(file).get("scenario"), str)


def _sweep_name(file: pathlib.Path) -> str:
    return str(_toml_of(file).get("name", file.stem))


def _sweep_file(name: str, scenario: Path, axes: Mapping[str, Sequence[object]],
                seeds: int | Sequence[int], set: Mapping[str, object]) -> str:
    file = pathlib.Path(scenario)
    if not file.is_file():
        raise program.SofofError(f"{scenario}: there is no such file.", 2)
    of_seeds = seeds if isinstance(seeds, int) else list(seeds)
    lines = [f"name = {program.toml(name)}",
             f"scenario = {program.toml(file.resolve())}",
             f"seeds = {program.toml(of_seeds)}", "[set]"]
    lines += [f"{program.toml(k)} = {program.toml(v)}" for k, v in set.items()]
    for key, values in axes.items():
        lines += ["[[axis]]", f"key = {program.toml(key)}",
                  f"values = {program.toml(list(values))}"]
    return "\n".join(lines) + "\n"


def bench(scenarios: Iterable[Path] | Path, policies: Iterable[str] = ("all",),
          entrants: Mapping[str, Mapping[str, object]] | None = None,
          seeds: int = 3, set: Mapping[str, object] | None = None,
          out: Path | None = None, jobs: int | None = None) -> Leaderboard:
    """Ranks policies in scenarios (docs/bench.md).

    Args:
        scenarios: files.
        policies: who takes part, "all" or names, of `entrants` too.
        entrants: further ones, by their names:
            {"mine": {"lodm": process("mine.py"), "codm": "edf"}}.
        seeds: how many, from 1 on.
        set: options to change in all runs, none of policies.
        out: folder of all results; by default results/bench.
        jobs: runs at a time; by default as many as there are cores.

    Raises:
        SofofError: the input is wrong, or nothing could be ranked.
    """
    if isinstance(scenarios, (str, os.PathLike)):
        scenarios = [scenarios]
    folder = pathlib.Path(out or "results/bench")
    with tempfile.TemporaryDirectory(prefix="sofof_") as at:
        words = ["bench", *map(_existing, scenarios), "--policies",
                 ",".join(policies), f"--seeds={seeds}", "--out", str(folder),
                 "--quiet"]
        if entrants:
            file = pathlib.Path(at) / "entrants.toml"
            file.write_text("".join(f"{program.toml(k)} = {program.toml(v)}\n"
                                    for k, v in entrants.items()))
            words += ["--entrants", str(file)]
        if jobs is not None:
            words.append(f"-j{jobs}")
        _call([*words, *program.settings(set or {})],
              folder / "leaderboard.csv")
    return Leaderboard(folder)


def process(script: Path, *arguments: str,
            **options: object) -> dict[str, object]:
    """A policy that is a program, as `set` and `entrants` take it.

    Args:
        script: a file; with the ending .py it is run by this Python.
        arguments: of the script.
        options: further ones of the policy, time_limit="1s".

    Raises:
        SofofError: there is no such file.
    """
    path = pathlib.Path(script).resolve()
    if not path.is_file():
        raise program.SofofError(f"{script}: there is no such file.", 2)
    python = [sys.executable or shutil.which("python3") or "python3"]
    words = [*(python if path.suffix == ".py" else []), path.name, *arguments]
    if path.suffix != ".py":
        words[0] = str(path)
    return {"name": "process", "command": shlex.join(words),
            "folder": str(path.parent), **options}
