"""SOFOF from Python: runs and their results as data frames, plots, policies as
processes, and environments for agents that learn.

Nothing here needs more than the standard library to be imported; numpy, pandas
and matplotlib are imported by what uses them. Names are resolved when they are
first used, so that a policy's process starts fast.
"""
import importlib
from typing import TYPE_CHECKING

__version__ = "0.1.0"

# Which module has which name.
_WHERE = {
    "SofofError": "program",
    "Results": "results",
    "load": "results",
    "run": "runs",
    "sweep": "runs",
    "bench": "runs",
    "process": "runs",
    "Sweep": "sweeps",
    "Leaderboard": "sweeps",
    "Policy": "policy",
    "Ask": "policy",
    "Told": "policy",
    "stay": "policy",
    "come_home": "policy",
    "run_at": "policy",
    "OffloadingEnv": "environment",
    "env": "multi_agent",
    "parallel_env": "multi_agent",
}
__all__ = [*_WHERE, "plots"]


def __getattr__(name: str):
    if name == "plots":
        return importlib.import_module(".plots", __name__)
    if name not in _WHERE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(importlib.import_module("." + _WHERE[name], __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)


if TYPE_CHECKING:
    from . import plots
    from .environment import OffloadingEnv
    from .multi_agent import env, parallel_env
    from .policy import Ask, Policy, Told, come_home, run_at, stay
    from .program import SofofError
    from .results import Results, load
    from .runs import bench, process, run, sweep
    from .sweeps import Leaderboard, Sweep
