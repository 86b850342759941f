"""An agent for each vehicle: PettingZoo's interfaces, in turn (AEC) and at the
same time (parallel)."""
from collections.abc import Iterator, Mapping
from typing import Any

from . import observation, spaces
from .episode import Episode, Setting
from .policy import Ask

try:
    from pettingzoo import AECEnv as _AECEnv, ParallelEnv as _ParallelEnv
except ImportError:
    _AECEnv = _ParallelEnv = object  # type: ignore[assignment,misc]

GRID_S = 1.0  # of the parallel environment


def name_of(station: int) -> str:
    """What the agent of a vehicle is called."""
    return f"vehicle_{station}"


class _Fleet:
    """What both have: agents, their spaces, an episode at a time."""

    def __init__(self, setting: Setting):
        self._setting = setting
        self.possible_agents = [name_of(x) for x in setting.stations]
        self.agents: list[str] = []
        self.render_mode = None
        self.observation_spaces = {
            x: observation.observation_space(setting.providers)
            for x in self.possible_agents}
        self.action_spaces = {x: spaces.discrete(1 + setting.providers)
                              for x in self.possible_agents}
        self._next_seed = 1
        self._episode: Episode | None = None
        self._ask: Ask | None = None
        self._asks: dict[str, Ask] = {}

    def observation_space(self, agent: str) -> Any:
        """Of an agent: the same object each time."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> Any:
        """Of an agent: the same object each time."""
        return self.action_spaces[agent]

    @property
    def num_agents(self) -> int:
        return len(self.agents)

    @property
    def max_num_agents(self) -> int:
        return len(self.possible_agents)

    @property
    def unwrapped(self) -> Any:
        return self

    def render(self) -> None:
        """Shows nothing: `sofof run --live` does."""

    def close(self) -> None:
        """Ends the episode; nothing of it stays. May be called twice."""
        if self._episode:
            self._episode.close()
        self._episode = self._ask = None

    @property
    def _running(self) -> Episode:
        if self._episode is None:
            raise RuntimeError("No episode runs; reset() begins one.")
        return self._episode

    def _begin(self, seed: int | None) -> None:
        self.close()
        run_seed = self._next_seed if seed is None else int(seed)
        self._next_seed = run_seed + 1
        self.agents = list(self.possible_agents)
        self._asks = {}
        self._episode = Episode(self._setting, run_seed)
        self._go_on()
        self._episode.costs.take()

    def _go_on(self) -> None:
        """To the next ask, or to the end."""
        try:
            self._ask = self._running.next()
        except BaseException:
            self.close()
            raise
        if self._ask is not None:
            self._asks[name_of(self._ask.station)] = self._ask

    def _observe(self, agent: str) -> Any:
        ask = self._asks.get(agent)
        if ask is None:
            return observation.nothing(self._setting.providers)
        return observation.observe(ask, self._setting.providers)

    def _info(self, agent: str) -> dict[str, Any]:
        ask = self._asks.get(agent)
        return {"t_s": ask.t_s if ask else 0.0,
                "action_mask": observation.mask_of(ask,
                                                   self._setting.providers)}


class FleetAEC(_Fleet, _AECEnv):
    """In turn: whose vehicle is asked acts next. Made by `sofof.env`.

    All agents are there from the beginning to the end of the run, which
    truncates them; one whose vehicle is not on the road, or has no provider to
    ask, is not selected meanwhile. `infos[agent]["action_mask"]` tells what
    does something, and at the end "summary" has the figures of the run.
    """
    metadata: dict[str, Any] = {"name": "sofof_v1", "render_modes": [],
                                "is_parallelizable": False}

    def reset(self, seed: int | None = None,
              options: dict[str, Any] | None = None) -> None:
        """Begins an episode; `seed` as in `OffloadingEnv.reset`."""
        self._begin(seed)
        self.rewards = dict.fromkeys(self.agents, 0.0)
        self._cumulative_rewards = dict.fromkeys(self.agents, 0.0)
        self.terminations = dict.fromkeys(self.agents, False)
        self.truncations = dict.fromkeys(self.agents, False)
        self.infos = {x: self._info(x) for x in self.agents}
        self.agent_selection = self.agents[0]
        self._select()

    def observe(self, agent: str) -> Any:
        """What an agent sees: as of when it was last asked."""
        return self._observe(agent)

    def last(self, observe: bool = True) -> tuple[Any, float, bool, bool,
                                                  dict[str, Any]]:
        """Of the agent that acts next: observation, reward since its last
        action, terminated, truncated, info."""
        agent = self.agent_selection
        return (self.observe(agent) if observe else None,
                self._cumulative_rewards[agent], self.terminations[agent],
                self.truncations[agent], self.infos[agent])

    def agent_iter(self, max_iter: int = 2**63) -> Iterator[str]:
        """Whoever acts next, until nobody does."""
        while self.agents and max_iter > 0:
            max_iter -= 1
            yield self.agent_selection

    def step(self, action: int | None) -> None:
        """Acts for the selected agent; one that is done takes None.

        Raises:
            RuntimeError: nobody is there; `reset` begins an episode.
            ValueError: there is no such action.
            SofofError: the run has failed.
        """
        if not self.agents:
            raise RuntimeError("No episode runs; reset() begins one.")
        running, agent = self._running, self.agent_selection
        if self.truncations[agent]:
            self._leave(agent, action)
            return
        if (self._ask is None or action is None
                or not self.action_spaces[agent].contains(action)):
            raise ValueError(f"Action {action!r}: not in "
                             f"{self.action_spaces[agent]}.")
        self._cumulative_rewards[agent] = 0.0
        running.act(self._ask, action)
        self._go_on()
        self.rewards = dict.fromkeys(self.agents, 0.0)
        for station, reward in running.costs.take().items():
            if name_of(station) in self.rewards:
                self.rewards[name_of(station)] = reward
                self._cumulative_rewards[name_of(station)] += reward
        self._select()

    def _select(self) -> None:
        if self._ask is not None:
            self.agent_selection = name_of(self._ask.station)
            self.infos[self.agent_selection] = self._info(self.agent_selection)
            return
        self.truncations = dict.fromkeys(self.agents, True)
        for agent in self.agents:
            self.infos[agent]["summary"] = self._running.summary
        self.agent_selection = self.agents[0]

    def _leave(self, agent: str, action: int | None) -> None:
        if action is not None:
            raise ValueError(f"{agent} is done: its last action is None.")
        self.agents.remove(agent)
        of_agents: tuple[dict[str, Any], ...] = (
            self._cumulative_rewards, self.terminations, self.truncations,
            self.infos)
        for of_agent in of_agents:
            del of_agent[agent]
        self.rewards = dict.fromkeys(self.agents, 0.0)
        if self.agents:
            self.agent_selection = self.agents[0]


class FleetParallel(_Fleet, _ParallelEnv):
    """At the same time: all agents act once in each second of the run. Made by
    `sofof.parallel_env`.

    An action holds for a second: whenever a vehicle is asked meanwhile, it
    answers by it. An observation is what the vehicle saw when it was last
    asked, `infos[agent]["t_s"]`; `action_mask` what it could do then.
    """
    metadata: dict[str, Any] = {"name": "sofof_parallel_v1",
                                "render_modes": []}

    def reset(self, seed: int | None = None,
              options: dict[str, Any] | None = None) -> tuple[
                  dict[str, Any], dict[str, dict[str, Any]]]:
        """Begins an episode; `seed` as in `OffloadingEnv.reset`."""
        self._begin(seed)
        self._second = int(self._ask.t_s / GRID_S) if self._ask else 0
        return ({x: self._observe(x) for x in self.agents},
                {x: self._info(x) for x in self.agents})

    def step(self, actions: Mapping[str, int]) -> tuple[
            dict[str, Any], dict[str, float], dict[str, bool],
            dict[str, bool], dict[str, dict[str, Any]]]:
        """Drives on by a second.

        Args:
            actions: by agent; one without any leaves its service where it is.

        Returns:
            observations, rewards, terminations, truncations, infos.

        Raises:
            RuntimeError: nobody is there; `reset` begins an episode.
            ValueError: there is no such action.
            SofofError: the run has failed.
        """
        if not self.agents:
            raise RuntimeError("No episode runs; reset() begins one.")
        running = self._running
        for agent, action in actions.items():
            if not self.action_space(agent).contains(action):
                raise ValueError(f"Action {action!r} of {agent}: not in "
                                 f"{self.action_space(agent)}.")
        self._second += 1
        while self._ask is not None and self._ask.t_s < self._second * GRID_S:
            agent = name_of(self._ask.station)
            if agent in actions:
                running.act(self._ask, actions[agent])
            else:
                running.leave(self._ask)
            self._go_on()
        rewards = dict.fromkeys(self.agents, 0.0)
        for station, reward in running.costs.take().items():
            if name_of(station) in rewards:
                rewards[name_of(station)] = reward
        return self._all(rewards)

    def _all(self, rewards: dict[str, float]) -> Any:
        agents, over = self.agents, self._ask is None
        infos = {x: self._info(x) for x in agents}
        if over:
            self.agents = []
            for info in infos.values():
                info["summary"] = self._running.summary
        return ({x: self._observe(x) for x in agents}, rewards,
                dict.fromkeys(agents, False), dict.fromkeys(agents, over),
                infos)


def env(scenario: Any, set: Mapping[str, object] | None = None,
        duration: str | float | None = None,
        service: str = "trajectory_planning", epoch_s: float = 0.5,
        policy: Mapping[str, object] | None = None) -> FleetAEC:
    """PettingZoo's AEC environment of a scenario; arguments as those of
    `OffloadingEnv`.

    Raises:
        SofofError: the scenario is wrong.
    """
    return FleetAEC(Setting(scenario, set, duration, service, epoch_s, policy))


def parallel_env(scenario: Any, set: Mapping[str, object] | None = None,
                 duration: str | float | None = None,
                 service: str = "trajectory_planning",
                 policy: Mapping[str, object] | None = None) -> FleetParallel:
    """PettingZoo's parallel environment of a scenario, a step a second;
    arguments as those of `OffloadingEnv`.

    Raises:
        SofofError: the scenario is wrong.
    """
    return FleetParallel(Setting(scenario, set, duration, service, GRID_S,
                                 policy))
