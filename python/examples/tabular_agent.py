"""A small agent: a table of what each action is worth in each of a few states,
for all vehicles, learned by Q-learning. Needs numpy.

    tabular_agent.py train q.txt [--scenario FILE] [--episodes N]
    tabular_agent.py rank q.txt [--scenario FILE] [--seeds N]
    tabular_agent.py decide q.txt     (as the process of a policy)
"""
import argparse
import pathlib
import sys

import numpy

import sofof
from sofof import observation

SCENARIO = (pathlib.Path(__file__).resolve().parents[2] / "config" / "bench"
            / "mixed_fleet.toml")
FIRST_SEED = 1000  # of training: rankings begin with 1
EPOCH_S = 0.5
STAYS, CHANGES = 0, 1
LEAST_RATE = 0.005  # the others learn, too
# Edges of bins, by the place of what is seen: of the vehicle, of a provider.
OF_VEHICLE = {3: (0.09, 0.15)}  # time of a cycle on board / max_latency
OF_PROVIDER = {2: (0.27, 0.40, 0.49),  # utilisation / 2
               6: (0.50,)}             # 99 % of the latency / (2 max_latency)
SHAPE = (2, *(len(x) + 1 for of in (OF_VEHICLE, OF_PROVIDER)
              for x in of.values()), 2)


def state_of(seen, place: int) -> tuple[int, ...]:
    """Of what a vehicle sees of the provider at a place, from 1 on."""
    at = observation.OF_VEHICLE + observation.OF_PROVIDER * (place - 1)
    places = [*OF_VEHICLE.items(),
              *((at + k, edges) for k, edges in OF_PROVIDER.items())]
    bins = (sum(seen[k] >= edge for edge in edges) for k, edges in places)
    return (int(seen[at + 1] > 0.5), *bins)


def best_place(table, seen, mask) -> tuple[int, tuple[int, ...] | None]:
    """Where the service is, or where a change pays most; and the state that
    this is judged by, None where there is nobody."""
    places = [k for k in range(1, len(mask)) if mask[k]]
    states = {k: state_of(seen, k) for k in places}
    for k, state in states.items():
        if state[0]:
            return k, state
    if not places:
        return 0, None
    k = max(places, key=lambda k: advantage(table, states[k]))
    return k, states[k]


def advantage(table, state) -> float:
    """Of changing over staying."""
    return table[state][CHANGES] - table[state][STAYS]


def action_of(place: int, state, change: int) -> int:
    """Where the service shall run."""
    is_there = bool(state[0])
    return place if is_there != bool(change) else 0


class Learner:
    """Q-learning of all vehicles into one table.

    Args:
        decay: of the rate of learning with the samples of a state and action.
        discount: of an epoch.
        switch_cost: of a change: it is a request, and a plan of another source.
    """

    def __init__(self, seed: int = 1, discount: float = 0.95,
                 decay: float = 0.6, switch_cost: float = 0.05):
        self.table = numpy.zeros(SHAPE)
        self.samples = numpy.zeros(SHAPE)
        self.random = numpy.random.default_rng(seed)
        self.discount, self.decay = discount, decay
        self.switch_cost = switch_cost
        self.open: dict[str, tuple] = {}  # a step by agent

    def choose(self, agent: str, seen, reward: float, mask,
               explore: float) -> int:
        """Learns from the step before, and takes the next one."""
        place, state = best_place(self.table, seen, mask)
        self.learn(agent, reward, state)
        if state is None:
            return 0
        if self.random.random() < explore:
            change = int(self.random.integers(2))
        else:
            change = int(advantage(self.table, state) > 0)
        self.open[agent] = (*state, change)
        return action_of(place, state, change)

    def learn(self, agent: str, reward: float, state) -> None:
        step = self.open.pop(agent, None)
        if step is None:
            return
        to_come = self.table[state].max() if state is not None else 0.0
        self.samples[step] += 1
        rate = max(LEAST_RATE, 1 / self.samples[step] ** self.decay)
        reward -= self.switch_cost * step[-1]
        self.table[step] += rate * (reward + self.discount * to_come
                                    - self.table[step])


def train(file: str, scenario: str, episodes: int) -> None:
    """Drives, and writes the table as it was after the episode that cost least:
    all vehicles learn at once, and now and then they unlearn together."""
    env = sofof.env(scenario, epoch_s=EPOCH_S)
    learner, best = Learner(), (float("inf"), numpy.zeros(SHAPE))
    for episode in range(episodes):
        explore = max(0.01, 0.15 * (1 - 1.5 * episode / episodes))
        learner.open.clear()
        env.reset(seed=FIRST_SEED + episode)
        earned = 0.0
        for agent in env.agent_iter():
            seen, reward, _, over, info = env.last()
            earned += reward
            if over:
                env.step(None)
                summary = info["summary"]
            else:
                env.step(learner.choose(agent, seen, reward,
                                        info["action_mask"], explore))
        cost = -earned / summary["safety"]["driven_s"]
        if cost < best[0]:
            best = cost, learner.table.copy()
        print(f"episode {episode}: cost {cost:.4f}, "
              f"{summary['offloaded_share']:.1%} offloaded", flush=True)
    env.close()
    numpy.savetxt(file, best[1].reshape(-1, 2))
    print(f"table in {file}")


class Tabular(sofof.Policy):
    """The table as a policy."""

    version = "1"  # the table is on the command line: its content counts

    def __init__(self, file: str):
        self.table = numpy.loadtxt(file).reshape(SHAPE)

    def decide(self, ask: sofof.Ask):
        known = [*ask.providers, *([ask.here] if ask.here else [])]
        count = max((observation.place_of(x.id) for x in known), default=0)
        place, state = best_place(self.table, observation.observe(ask, count),
                                  observation.mask_of(ask, count))
        if state is None:
            return sofof.stay("nobody is there")
        change = int(advantage(self.table, state) > 0)
        return observation.decision_of(action_of(place, state, change), ask)


def rank(file: str, scenario: str, seeds: int, out: str) -> None:
    """Prints the leaderboard."""
    mine = sofof.process(__file__, "decide", str(pathlib.Path(file).resolve()),
                         epoch_s=EPOCH_S, filter="none")
    board = sofof.bench(scenario, ["random", "always", "location", "table"],
                        entrants={"table": {"lodm": mine}}, seeds=seeds,
                        out=out)
    for _, row in board.of().iterrows():
        print(f"{row['place']}  {row['entrant']:10s} {row['score']:.4f} "
              f"({row['score_low']:.4f} to {row['score_high']:.4f})")


def main() -> None:
    words = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    words.add_argument("what", choices=("train", "rank", "decide"))
    words.add_argument("file", help="the table")
    words.add_argument("--scenario", default=str(SCENARIO))
    words.add_argument("--episodes", type=int, default=24)
    words.add_argument("--seeds", type=int, default=8)
    words.add_argument("--out", default="results/tabular_agent")
    given = words.parse_args()
    if given.what == "train":
        train(given.file, given.scenario, given.episodes)
    elif given.what == "rank":
        rank(given.file, given.scenario, given.seeds, given.out)
    else:
        Tabular(given.file).run()


if __name__ == "__main__":
    sys.exit(main())
