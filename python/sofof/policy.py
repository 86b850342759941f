"""Policies as programs: the base class of one, and what it is asked and told
(docs/policy_process.md)."""
import functools
import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass, field, fields
from typing import Any, ClassVar, Self, TextIO

PROTOCOL = 1  # its version

Decision = dict[str, Any]


@functools.cache
def _names(cls: Any) -> frozenset[str]:
    return frozenset(x.name for x in fields(cls))


class _Read:
    """Something that is made of a JSON object; members that this version does
    not know are left out."""

    _parts: ClassVar[dict[str, type["_Read"]]] = {}

    @classmethod
    def of(cls, text: dict[str, Any]) -> Self:
        kind: Any = cls  # which can be hashed
        known = _names(kind)
        made = {}
        for name, value in text.items():
            if name not in known:
                continue
            part = cls._parts.get(name)
            if part and isinstance(value, list):
                value = [part.of(x) for x in value]
            elif part and value is not None:
                value = part.of(value)
            made[name] = value
        return cls(**made)


@dataclass(slots=True)
class Provider(_Read):
    """What a vehicle knows of a provider.

    Attributes:
        id: its number; `id % 65536` is its place in the scenario, from 1 on.
        x_m, y_m: where it is, m.
        east_mps, north_mps, reach_m: of one that rides with a vehicle, m/s and
            m: how it moves, and how near it serves; else 0, 0, None.
        utilisation: the share of its workers that what runs there needs, >= 0.
        workers: how many.
        computing_s: mean time of a result of this service there, s.
        late, gap: P(a result is too late), P(the next one is), in [0, 1].
        median_s, p99_s: of its latency, s; None: too little came.
        time_s, energy_j: of a cycle there, for the vehicle: s, J.
        gain: what a cycle there costs less than one on board, without unit.
    """
    id: int
    x_m: float = 0.0
    y_m: float = 0.0
    east_mps: float = 0.0
    north_mps: float = 0.0
    reach_m: float | None = None
    utilisation: float = 0.0
    workers: int = 1
    computing_s: float = 0.0
    late: float = 1.0
    gap: float = 1.0
    median_s: float | None = None
    p99_s: float | None = None
    time_s: float | None = None
    energy_j: float | None = None
    gain: float = 0.0


@dataclass(slots=True)
class Needs(_Read):
    """What a service needs, s; None: no limit."""
    period_s: float | None = None
    max_latency_s: float | None = None
    max_interarrival_s: float | None = None
    worst_response_s: float | None = None


@dataclass(slots=True)
class Cost(_Read):
    """Of a cycle in the vehicle: s, J."""
    time_s: float | None = None
    energy_j: float | None = None


@dataclass(slots=True)
class Ask(_Read):
    """A decision that is due. A vehicle's has what stands first; a provider's
    (`policy` is "codm") has `requests`, `sessions` and the like, as they came.

    Attributes:
        n: its number.
        policy: "lodm" or "codm".
        t_s: now, s since the beginning.
        station, service: whose, and of which service.
        current: the provider where it runs; None: in the vehicle.
        since_s: since when, as `t_s`.
        here: what is known of that provider.
        providers: those that may be asked.
        path: planned, from the vehicle on, [x, y], m.
        speed_mps: of the vehicle, m/s.
        needs, on_board: of the service; of a cycle in the vehicle.
        draws: four random numbers in [0, 1) of this decision.
        raw: all of it as it came.
    """
    n: int
    policy: str = "lodm"
    t_s: float = 0.0
    station: int = 0
    service: str = ""
    current: int | None = None
    since_s: float = 0.0
    here: Provider | None = None
    providers: list[Provider] = field(default_factory=list)
    path: list[list[float]] = field(default_factory=list)
    speed_mps: float = 0.0
    needs: Needs = field(default_factory=Needs)
    on_board: Cost = field(default_factory=Cost)
    draws: list[float] = field(default_factory=list)
    safe_response_s: float | None = None
    forecasts: list[dict[str, Any]] = field(default_factory=list)
    chain: list[dict[str, Any]] = field(default_factory=list)
    provider: int = 0
    utilisation: float = 0.0
    workers: int = 1
    area: list[list[float]] = field(default_factory=list)
    east_mps: float = 0.0
    north_mps: float = 0.0
    requests: list[dict[str, Any]] = field(default_factory=list)
    sessions: list[dict[str, Any]] = field(default_factory=list)
    raw: dict[str, Any] = field(default_factory=dict, repr=False)

    _parts: ClassVar = {"here": Provider, "providers": Provider,
                        "needs": Needs, "on_board": Cost}

    @classmethod
    def of(cls, text: dict[str, Any]) -> Self:
        made = super(Ask, cls).of(text)
        made.raw = text
        return made


@dataclass(slots=True)
class Told(_Read):
    """Something that has come of a decision.

    Attributes:
        what: "cycle", "refusal" or "episode".
        station, service: whose.
        provider: of a refusal or an episode.
        computed_at: of a cycle; None: in the vehicle.
        latency_s: of a cycle; None: nothing came.
        missed: whether it was late, or did not come.
        energy_j: of each cycle, of the vehicle.
        cycles: how many were like this.
        remote_s, end_reason: of an episode.
    """
    what: str
    station: int = 0
    service: str = ""
    t_s: float | None = None
    provider: int | None = None
    computed_at: int | None = None
    latency_s: float | None = None
    missed: bool = False
    energy_j: float = 0.0
    cycles: float = 1
    why: str = ""
    remote_s: float = 0.0
    end_reason: str = ""


def stay(why: str = "") -> Decision:
    """The service stays where it is."""
    return _with_reason({"do": "stay"}, why)


def come_home(why: str = "") -> Decision:
    """The service runs in the vehicle, and nobody is asked."""
    return _with_reason({"do": "come_home"}, why)


def run_at(provider: Provider | int, why: str = "",
           second: Provider | int | None = None, hedge_after_s: float = 0,
           advantage: float | None = None) -> Decision:
    """The service shall run at a provider; where it does, it stays.

    Args:
        provider: one of `ask.providers`, or its id.
        why: for the records, at most 80 characters of ASCII.
        second: another one that runs it at the same time;
        hedge_after_s: with more than 0 it computes only what the first has not
            answered by then.
        advantage: a gain over where it runs, for the governor `hysteresis`.
    """
    decision: Decision = {"do": "run_at", "provider": _id(provider)}
    if second is not None:
        decision["second"] = {"provider": _id(second),
                              "hedge_after_s": hedge_after_s}
    if advantage is not None:
        decision["advantage"] = advantage
    return _with_reason(decision, why)


def _id(provider: Provider | int) -> int:
    return provider.id if isinstance(provider, Provider) else int(provider)


def _with_reason(decision: Decision, why: str) -> Decision:
    return {**decision, "why": why} if why else decision


def line_of(message: dict[str, Any]) -> str:
    """A message as it goes over the line, its end included."""
    return json.dumps(message, separators=(",", ":"), allow_nan=False) + "\n"


class Policy:
    """A policy: make a class of it that defines `decide`, and call its `run`.

    Attributes:
        name: what it is called in results; by default that of the class.
        version: of the program. Without one no run that it decides is ever
            taken from an earlier one: give another whenever it decides anew.
        tells, forecast, scene, chain: what else it wants to be told; `tells`
            is true where `told` is defined.
    """
    name: str = ""
    version: str = ""
    forecast: bool = False
    scene: bool = False
    chain: bool = False

    # What it was greeted with.
    side: str = ""
    scenario: str = ""
    seed: int = 0

    def decide(self, ask: Ask) -> Decision | Sequence[bool]:
        """The answer: of a vehicle `stay()`, `come_home()` or `run_at(...)`; of
        a provider one yes or no for each of `ask.requests`, or the answer as
        docs/policy_process.md has it, without `n`."""
        raise NotImplementedError

    def told(self, told: Told) -> None:
        """Takes note of what has come of decisions."""

    def begin(self) -> None:
        """Gets ready: `side`, `scenario` and `seed` are known now."""

    def run(self, input: TextIO | None = None,
            output: TextIO | None = None) -> None:
        """Answers until the run is over.

        Args:
            input, output: of the process, unless others are given.

        Raises:
            ValueError: a line is none of this protocol, or of another version.
        """
        lines = input or sys.stdin
        out = output or sys.stdout
        if output is None:
            sys.stdout = sys.stderr  # what a policy prints is no answer
        for line in lines:
            message = json.loads(line)
            kind = message.get("type")
            if kind == "ask":
                out.write(line_of(self._answer(Ask.of(message))))
                out.flush()
            elif kind == "told":
                self.told(Told.of(message))
            elif kind == "hello":
                out.write(line_of(self._greet(message)))
                out.flush()
            elif kind == "bye":
                return

    def _greet(self, hello: dict[str, Any]) -> dict[str, Any]:
        if hello.get("sofof") != PROTOCOL:
            raise ValueError(f"version {hello.get('sofof')} of the protocol; "
                             f"this is {PROTOCOL}")
        self.side = hello["policy"]
        self.scenario = hello["scenario"]
        self.seed = hello["seed"]
        self.begin()
        answer: dict[str, Any] = {"sofof": PROTOCOL,
                                  "name": self.name or type(self).__name__}
        if self.version:
            answer["version"] = self.version
        if type(self).told is not Policy.told:
            answer["tells"] = True
        for wish in ("forecast", "scene", "chain"):
            if getattr(self, wish):
                answer[wish] = True
        return answer

    def _answer(self, ask: Ask) -> dict[str, Any]:
        decision = self.decide(ask)
        if isinstance(decision, dict):
            return {"n": ask.n, **decision}
        if ask.policy != "codm":
            raise ValueError(f"{type(self).__name__}.decide returned "
                             f"{decision!r}; return stay(), come_home() or "
                             "run_at(...).")
        return {"n": ask.n, "requests": [{"accept": bool(x)} for x in decision]}
