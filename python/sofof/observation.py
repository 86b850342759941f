"""What agents see, do and earn: the same for all environments.

**Observation**, a float32 vector. First, of the vehicle and its service:

    0  speed / 50 m/s
    1  1 where the service runs at a provider, 0 on board
    2  how long it has been there / 60 s
    3  time of a cycle on board / max_latency

then eight for each provider, in the order of the scenario:

    0  1 if it may be asked, or the service runs there
    1  1 if the service runs there
    2  its utilisation / 2
    3  its distance / 1000 m
    4  P(a result is late)
    5  P(the next result comes too late)
    6  99 % of the latency / (2 max_latency); 1 if that is not known yet
    7  gain of a cycle there over one on board

Each is cut off at 0 and 1, a gain at -1 and 1. Of a provider that may not be
asked all are 0.

**Action**: where the service shall run: 0 in the vehicle, k at the scenario's
provider k. A provider that may not be asked (`action_mask` has 0) leaves the
service where it is.

**Reward**: minus what the cycles since the last step cost, by the score of
docs/bench.md, times their period:

    - sum of (0.3 T / max_latency + 0.3 E / E_board + [missed]) * period_s

with T the latency, max_latency for a result that never came, and E the energy
of the vehicle, E_board that of a cycle on board, the mean of all vehicles that
have been asked so far: whose computer takes most has most to save. So the
return of an episode over the seconds that vehicles drove is minus the mean cost
of a cycle, the score (of one service; there a stretch of late results counts
once).
"""
from collections.abc import Mapping, Sequence
from typing import Any

from . import spaces
from .policy import Ask, Decision, Provider, come_home, run_at, stay

OF_VEHICLE = 4
OF_PROVIDER = 8
TIME_WEIGHT = 0.3
ENERGY_WEIGHT = 0.3
MISS_WEIGHT = 1.0
RESTARTS = 65536  # a provider that has failed and is back has so much more


def place_of(provider: int) -> int:
    """A provider's place in the scenario, from 1 on."""
    return provider % RESTARTS


def observation_space(providers: int) -> Any:
    """The space of observations with so many providers."""
    low = [0.0] * OF_VEHICLE + ([0.0] * (OF_PROVIDER - 1) + [-1.0]) * providers
    return spaces.box(low, [1.0] * len(low))


def nothing(providers: int) -> Any:
    """What an agent sees that has not been asked yet."""
    return spaces.vector([0.0] * (OF_VEHICLE + OF_PROVIDER * providers))


def mask_of(ask: Ask | None, providers: int) -> Any:
    """1 for each action that does something."""
    allowed = [1] + [0] * providers
    for k in _askable(ask) if ask else ():
        if k <= providers:
            allowed[k] = 1
    return spaces.mask(allowed)


def _askable(ask: Ask) -> dict[int, Provider]:
    """By place; where two numbers have one place, the newer counts."""
    known = [ask.here] if ask.here else []
    return {place_of(x.id): x
            for x in sorted([*known, *ask.providers], key=lambda x: x.id)}


def observe(ask: Ask, providers: int) -> Any:
    """What the agent of a vehicle sees."""
    limit_s = ask.needs.max_latency_s or 1.0
    askable = _askable(ask)
    values = [_cut(ask.speed_mps / 50), float(ask.current is not None),
              _cut((ask.t_s - ask.since_s) / 60),
              _cut((ask.on_board.time_s or 0.0) / limit_s)]
    at = ask.path[0] if ask.path else None
    for k in range(1, providers + 1):
        values += _of_provider(askable.get(k), ask.current, limit_s, at)
    return spaces.vector(values)


def _of_provider(x: Provider | None, current: int | None, limit_s: float,
                 at: Sequence[float] | None) -> list[float]:
    if x is None:
        return [0.0] * OF_PROVIDER
    far_m = ((x.x_m - at[0]) ** 2 + (x.y_m - at[1]) ** 2) ** 0.5 if at else 0.0
    p99 = 1.0 if x.p99_s is None else x.p99_s / (2 * limit_s)
    return [1.0, float(x.id == current), _cut(x.utilisation / 2),
            _cut(far_m / 1000), _cut(x.late), _cut(x.gap), _cut(p99),
            _cut(x.gain, -1.0)]


def _cut(x: float, low: float = 0.0) -> float:
    return min(1.0, max(low, x))


def decision_of(action: int, ask: Ask) -> Decision:
    """What an action is in the words of the protocol."""
    if action == 0:
        return come_home("the agent")
    wanted = _askable(ask).get(action)
    if wanted is None:
        return stay("the agent, in vain")
    return run_at(wanted, "the agent")


class Costs:
    """What cycles cost, by station, since it was last taken."""

    def __init__(self, service: str):
        self.service = service
        self._needs: dict[int, tuple[float, float]] = {}
        self._board_j: dict[int, float] = {}
        self._mean_j = 0.0
        self._rewards: dict[int, float] = {}

    def on_ask(self, ask: Ask) -> None:
        """Remembers what cycles of this vehicle are measured by."""
        self._needs[ask.station] = (ask.needs.max_latency_s or 1.0,
                                    ask.needs.period_s or 1.0)
        board_j = ask.on_board.energy_j or 0.0
        if self._board_j.get(ask.station) != board_j:
            self._board_j[ask.station] = board_j
            self._mean_j = sum(self._board_j.values()) / len(self._board_j)

    def on_told(self, told: Mapping[str, Any]) -> None:
        """Counts a cycle, of a message as it came."""
        if told["what"] != "cycle" or told["service"] != self.service:
            return
        station = told["station"]
        needs = self._needs.get(station)
        if needs is None:
            return
        limit_s, period_s = needs
        late = limit_s if told["latency_s"] is None else told["latency_s"]
        cost = TIME_WEIGHT * late / limit_s + MISS_WEIGHT * told["missed"]
        if self._mean_j > 0:
            cost += ENERGY_WEIGHT * told["energy_j"] / self._mean_j
        old = self._rewards.get(station, 0.0)
        self._rewards[station] = old - cost * told["cycles"] * period_s

    def take(self) -> dict[int, float]:
        """Rewards by station; from now on they count from 0."""
        taken, self._rewards = self._rewards, {}
        return taken
