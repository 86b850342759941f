"""One agent for all vehicles, or for one: Gymnasium's interface."""
from collections.abc import Mapping
from typing import Any

from . import observation, spaces
from .episode import Episode, Others, Setting
from .policy import Ask

try:
    from gymnasium import Env as _Env
except ImportError:
    class _Env:  # type: ignore[no-redef]
        """As much of Gymnasium's as is used, where that is not installed."""

        metadata: dict[str, Any] = {}
        render_mode: str | None = None
        spec = None

        @property
        def unwrapped(self) -> Any:
            return self

        def __enter__(self) -> Any:
            return self

        def __exit__(self, *_: Any) -> None:
            self.close()  # type: ignore[attr-defined]


class OffloadingEnv(_Env):
    """A scenario of which an agent makes all offloading decisions of vehicles.

    Each step is a decision of one vehicle, each vehicle's once an `epoch_s`:
    `info["station"]` says whose. The reward is what all vehicles together have
    earned since the step before; `info["rewards"]` has it by station. What is
    seen and done, and what is earned, stands in `sofof.observation`.

    The end of the run truncates an episode (`terminated` is never true), and
    `info["summary"]` has the run's figures then. Environments are independent
    of each other: any number may be used at once, in a process or in several.

    Args:
        scenario: its file or name.
        set: options to change, {"fleet.0.count": 4}.
        duration: of an episode, "60s" or seconds; by default the scenario's.
        service: which one is decided about.
        epoch_s: how often each vehicle decides, s.
        policy: options of the LODM besides, {"filter": "location"}.
        station: the only vehicle that the agent decides for;
        others: then a function of an `Ask` decides for the others; by default
            they stay on board.

    Raises:
        SofofError: the scenario is wrong.
    """
    metadata: dict[str, Any] = {"render_modes": []}

    def __init__(self, scenario: Any, set: Mapping[str, object] | None = None,
                 duration: str | float | None = None,
                 service: str = "trajectory_planning", epoch_s: float = 0.5,
                 policy: Mapping[str, object] | None = None,
                 station: int | None = None, others: Others | None = None):
        self._setting = Setting(scenario, set, duration, service, epoch_s,
                                policy)
        if station is not None and station not in self._setting.stations:
            raise ValueError(f"{scenario} has no vehicle {station}.")
        self._station, self._others = station, others
        self.render_mode = None
        self.observation_space = observation.observation_space(
            self._setting.providers)
        self.action_space = spaces.discrete(1 + self._setting.providers)
        self._next_seed = 1
        self._episode: Episode | None = None
        self._ask: Ask | None = None

    def reset(self, *, seed: int | None = None,
              options: dict[str, Any] | None = None) -> tuple[
                  Any, dict[str, Any]]:
        """Begins an episode.

        Args:
            seed: of the run, 0 or more; without one, the next whole number
                after that of the episode before, 1 at first.
            options: none are known.

        Raises:
            SofofError: the run cannot be started.
        """
        self.close()
        if hasattr(super(), "reset"):
            super().reset(seed=seed)
        run_seed = self._next_seed if seed is None else int(seed)
        self._next_seed = run_seed + 1
        self._episode = Episode(self._setting, run_seed, self._station,
                                self._others)
        self._ask = self._episode.next()
        self._episode.costs.take()  # what came before the first step
        return self._seen(), self._info({})

    def step(self, action: int) -> tuple[Any, float, bool, bool,
                                         dict[str, Any]]:
        """Decides, and drives on to the next decision.

        Returns:
            observation, reward, terminated, truncated, info.

        Raises:
            RuntimeError: no episode runs; `reset` begins one.
            ValueError: there is no such action.
            SofofError: the run has failed.
        """
        if self._episode is None or self._ask is None:
            raise RuntimeError("No episode runs; reset() begins one.")
        if not self.action_space.contains(action):
            raise ValueError(f"Action {action!r}: not in {self.action_space}.")
        try:
            self._episode.act(self._ask, action)
            self._ask = self._episode.next()
        except BaseException:
            self.close()
            raise
        rewards = self._episode.costs.take()
        if self._station is not None:
            rewards = {k: v for k, v in rewards.items() if k == self._station}
        return (self._seen(), float(sum(rewards.values())), False,
                self._ask is None, self._info(rewards))

    def render(self) -> None:
        """Shows nothing: `sofof run --live` does."""

    def close(self) -> None:
        """Ends the episode; nothing of it stays. May be called twice."""
        if self._episode:
            self._episode.close()
        self._episode = self._ask = None

    def action_masks(self) -> Any:
        """1 for each action that does something now."""
        return observation.mask_of(self._ask, self._setting.providers)

    def _seen(self) -> Any:
        if self._ask is None:
            return observation.nothing(self._setting.providers)
        return observation.observe(self._ask, self._setting.providers)

    def _info(self, rewards: dict[int, float]) -> dict[str, Any]:
        info: dict[str, Any] = {"rewards": rewards,
                                "action_mask": self.action_masks()}
        if self._ask is not None:
            info |= {"station": self._ask.station, "t_s": self._ask.t_s}
        elif self._episode is not None:
            info["summary"] = self._episode.summary
        return info
