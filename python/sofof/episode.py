"""One run as its agents meet it: which asks are steps, and what was earned."""
import pathlib
from collections.abc import Callable, Mapping
from typing import Any

from . import observation
from .drive import Drive, effective
from .policy import Ask, Decision, stay

# A policy for the vehicles that no agent drives.
Others = Callable[[Ask], Decision]


def _stay(_: Ask) -> Decision:
    return stay("no agent's")


def _riders(fleet: Mapping[str, Any]) -> int:
    """How many of a fleet's vehicles provide for others."""
    if "provide" not in fleet:
        return 0
    return fleet["count"] if fleet["provide"]["cars"] == "all" else 1


class Setting:
    """What all episodes of an environment have in common.

    Args:
        scenario: its file or name.
        set: options to change.
        duration: of an episode; by default the scenario's.
        service: which one agents decide about; others stay on board.
        epoch_s: how often each vehicle is asked, s.
        policy: options of the LODM besides, {"filter": "location"}.

    Attributes:
        stations: of all vehicles that may offload.
        providers: how many there are, those in vehicles included.

    Raises:
        SofofError: the scenario is wrong, or has no such service.
    """

    def __init__(self, scenario: Any, set: Mapping[str, object] | None,
                 duration: str | float | None, service: str, epoch_s: float,
                 policy: Mapping[str, object] | None):
        path = pathlib.Path(scenario)
        self.scenario = str(path.resolve()) if path.is_file() else str(scenario)
        self.set = dict(set or {})
        self.duration = (f"{duration!r}s" if isinstance(duration, (int, float))
                         else duration)
        self.service = service
        self.epoch_s = epoch_s
        self.policy: dict[str, object] = {"epoch_s": float(epoch_s),
                                          **(policy or {})}
        config = effective(self.scenario, self.set, self.duration)
        self.stations = [fleet["first_station"] + k
                         for fleet in config["fleet"]
                         if fleet.get("connected", True)
                         for k in range(fleet["count"])]
        self.providers = len(config.get("provider", [])) + sum(
            _riders(fleet) for fleet in config["fleet"])
        known = [x["name"] for x in config["service"]]
        if service not in known:
            raise ValueError(f"{self.scenario} has no service {service!r}, but "
                             f"{', '.join(known)}.")


class Episode:
    """A run of which `step` after `step` is an agent's.

    A vehicle's step is due once an epoch: what it is asked in between, as
    another offer has come, leaves its service where it is.
    """

    def __init__(self, setting: Setting, seed: int, station: int | None = None,
                 others: Others | None = None):
        self.setting = setting
        self.costs = observation.Costs(setting.service)
        self.summary: dict[str, Any] = {}
        self._station = station
        self._others = others or _stay
        self._last: dict[int, float] = {}
        self._drive = Drive(setting.scenario, seed, setting.set,
                            setting.duration, setting.policy)

    def next(self) -> Ask | None:
        """The next step's ask; None at the end of the run."""
        while (message := self._drive.next()) is not None:
            if not isinstance(message, Ask):
                self.costs.on_told(message)
                continue
            if message.service != self.setting.service:
                self._drive.answer(message, _stay(message))
                continue
            self.costs.on_ask(message)
            if self._station not in (None, message.station):
                self._drive.answer(message, self._others(message))
            elif self._is_due(message):
                return message
            else:
                self._drive.answer(message, stay("not yet"))
        self.summary = self._drive.summary
        return None

    def _is_due(self, ask: Ask) -> bool:
        tolerance_s = 1e-6
        last = self._last.get(ask.station)
        if last is not None and (ask.t_s - last
                                 < self.setting.epoch_s - tolerance_s):
            return False
        self._last[ask.station] = ask.t_s
        return True

    def act(self, ask: Ask, action: int) -> None:
        """Answers an ask by an action."""
        self._drive.answer(ask, observation.decision_of(int(action), ask))

    def leave(self, ask: Ask) -> None:
        """Answers an ask so that nothing changes."""
        self._drive.answer(ask, stay("the agent"))

    def close(self) -> None:
        """Ends the run if it goes on."""
        self._drive.close()
