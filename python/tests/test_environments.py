"""Environments: as Gymnasium and PettingZoo want them; the same seeds, the same
rewards; nothing stays. With a toy program in place of the simulation, and once
with the simulation itself, $SOFOF."""
import gc
import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import warnings

import conformance
import here

import sofof
from sofof import observation, spaces

PROGRAM = os.environ.get("SOFOF")
TOY = str(here.TESTS / "toy_program.py")


def children() -> list[str]:
    """Processes that this one has started, and theirs."""
    found = []
    for task in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (task / "cmdline").read_bytes().decode().split("\0")
        except OSError:
            continue
        if any(tempfile.gettempdir() in x for x in words):
            found.append(" ".join(words))
    return found


def descriptors() -> int:
    return len(os.listdir("/proc/self/fd"))


class InToyWorld(here.InFolder):
    """With a folder for temporary files of its own, to see what stays."""

    def setUp(self):
        super().setUp()
        old = tempfile.tempdir
        tempfile.tempdir = str(self.folder)
        self.addCleanup(setattr, tempfile, "tempdir", old)
        os.environ["SOFOF"] = TOY
        self.addCleanup(restore)
        self.descriptors = descriptors()

    def nothing_stays(self):
        gc.collect()
        self.assertEqual(list(self.folder.iterdir()), [])
        self.assertEqual(children(), [])
        self.assertEqual(descriptors(), self.descriptors)


def restore() -> None:
    os.environ.pop("TOY", None)
    if PROGRAM:
        os.environ["SOFOF"] = PROGRAM
    else:
        os.environ.pop("SOFOF", None)


def play(env, seed: int, choose=lambda k: k % 3) -> list[float]:
    """Rewards of an episode."""
    env.reset(seed=seed)
    rewards, over = [], False
    while not over:
        _, reward, terminated, over, _ = env.step(choose(len(rewards)))
        rewards.append(reward)
    return rewards


class Conformance(InToyWorld):

    def test_one_agent_for_all(self):
        conformance.check_gymnasium(lambda: sofof.OffloadingEnv("toy"), self)
        self.nothing_stays()

    def test_agents_in_turn(self):
        conformance.check_aec(lambda: sofof.env("toy"), self)
        self.nothing_stays()

    def test_agents_at_the_same_time(self):
        conformance.check_parallel(lambda: sofof.parallel_env("toy"), self)
        self.nothing_stays()

    @here.needs("gymnasium")
    def test_gymnasiums_own_checker(self):
        from gymnasium.utils.env_checker import check_env

        env = sofof.OffloadingEnv("toy")
        check_env(env, skip_render_check=True)
        env.close()

    @here.needs("pettingzoo")
    def test_pettingzoos_own_checkers(self):
        from pettingzoo.test import api_test, parallel_api_test

        for check, make in ((api_test, sofof.env),
                            (parallel_api_test, sofof.parallel_env)):
            env = make("toy")
            check(env, num_cycles=100)
            env.close()


class Episodes(InToyWorld):

    def test_same_seeds_same_rewards_other_seeds_others(self):
        env = sofof.OffloadingEnv("toy")
        first = play(env, 7)
        self.assertEqual(play(env, 7), first)
        self.assertNotEqual(play(env, 8), first)
        env.reset(seed=6)
        env.reset()  # that is 7
        self.assertEqual([env.step(k % 3)[1] for k in range(len(first))], first)
        env.close()

    def test_a_step_is_due_once_an_epoch(self):
        env = sofof.OffloadingEnv("toy")
        self.assertEqual(len(play(env, 1)), 3 * 5)  # vehicles, seconds
        env.close()

    def test_rewards_are_costs_by_the_score(self):
        env = sofof.OffloadingEnv("toy")
        total = sum(play(env, 1))
        # 10 cycles of 0.1 s a second, T from 10 to 40 ms of 50, E 2 of 15 mJ.
        self.assertLess(total, -15 * (0.3 * 0.2 + 0.3 * 2 / 15))
        self.assertGreater(total, -15 * (0.3 * 0.8 + 0.3 * 2 / 15))
        env.close()

    def test_costs_of_a_missed_cycle(self):
        costs = observation.Costs("planning")
        costs.on_ask(sofof.Ask(1, station=5, service="planning"))
        told = {"what": "cycle", "station": 5, "service": "planning",
                "latency_s": None, "missed": True, "energy_j": 0, "cycles": 2}
        costs.on_told(told)  # 0.3 for the time, 1 for the miss, 1 s each
        costs.on_told({**told, "service": "climate"})
        costs.on_told({**told, "station": 6})
        costs.on_told({"what": "episode", "service": "planning"})
        self.assertEqual(costs.take(), {5: -2.6})
        self.assertEqual(costs.take(), {})

    def test_one_vehicle_alone(self):
        asked = []

        def others(ask):
            asked.append(ask.station)
            return sofof.stay()

        env = sofof.OffloadingEnv("toy", station=102, others=others)
        _, info = env.reset(seed=1)
        seen = {info["station"]}
        for _ in range(3):
            seen.add(env.step(0)[4]["station"])
        self.assertEqual(seen, {102})
        self.assertEqual(set(asked), {101, 103})
        env.close()
        with self.assertRaisesRegex(ValueError, "no vehicle 201"):
            sofof.OffloadingEnv("toy", station=201)  # it is not connected

    def test_what_may_not_be_asked_is_masked_and_changes_nothing(self):
        env = sofof.OffloadingEnv("toy")
        env.reset(seed=1)
        self.assertEqual(list(env.action_masks()), [1, 1, 0])
        env.step(2)  # in vain
        while (info := env.step(0)[4])["station"] != 101:
            pass
        self.assertEqual(list(info["action_mask"]), [1, 1, 1])
        env.close()

    def test_agents_see_where_they_are(self):
        env = sofof.env("toy")
        env.reset(seed=1)
        agent = env.agent_selection
        self.assertEqual(env.observe(agent)[1], 0)
        env.step(1)
        while env.agent_selection != agent:
            env.step(0)
        seen = env.observe(agent)
        self.assertEqual(seen[1], 1)
        at = observation.OF_VEHICLE
        self.assertEqual(list(seen[at:at + 2]), [1, 1])
        self.assertAlmostEqual(seen[at + 2], 0.2)  # utilisation 0.4
        env.close()

    def test_the_summary_comes_at_the_end(self):
        env = sofof.OffloadingEnv("toy")
        env.reset(seed=1)
        over = False
        while not over:
            _, _, _, over, info = env.step(0)
        self.assertEqual(info["summary"]["safety"]["driven_s"], 15)
        env.close()

    def test_several_at_once(self):
        alone = sofof.OffloadingEnv("toy")
        expected = [play(alone, seed) for seed in range(4)]
        envs = [sofof.OffloadingEnv("toy") for _ in range(4)]
        for seed, env in enumerate(envs):
            env.reset(seed=seed)
        got = [[] for _ in envs]
        for k in range(len(expected[0])):
            for env, rewards in zip(envs, got):
                rewards.append(env.step(k % 3)[1])
        self.assertEqual(got, expected)
        for env in (*envs, alone):
            env.close()
        self.nothing_stays()

    def test_it_does_without_numpy(self):
        script = ("import sys\n"
                  f"sys.path[:0] = [{str(here.PACKAGE)!r}]\n"
                  "import sofof\n"
                  "env = sofof.OffloadingEnv('toy')\n"
                  "seen, info = env.reset(seed=7)\n"
                  "assert type(seen) is list\n"
                  "assert seen in env.observation_space\n"
                  "assert 'numpy' not in sys.modules\n"
                  "print([env.step(k % 3)[1] for k in range(15)])\n")
        # Without the folders of the site there is no numpy.
        done = subprocess.run([sys.executable, "-I", "-S", "-c", script],
                              text=True, capture_output=True)
        self.assertEqual(done.stderr, "")
        self.assertEqual(done.stdout.strip(),
                         str(play(sofof.OffloadingEnv("toy"), 7)))

    def test_an_unknown_service_is_refused(self):
        with self.assertRaisesRegex(ValueError, "cabin_climate"):
            sofof.OffloadingEnv("toy", service="x")


class Endings(InToyWorld):

    def fails(self, how: str, sentence: str):
        os.environ["TOY"] = how
        with self.assertRaisesRegex(sofof.SofofError, sentence):
            play(sofof.OffloadingEnv("toy"), 1)
        self.nothing_stays()

    def test_a_scenario_that_is_refused(self):
        self.fails("refuses", "toy.toml:1:1: it is no good")

    def test_a_program_that_dies(self):
        self.fails("dies", "the worker fell over")

    def test_a_program_that_never_starts_the_policy(self):
        self.fails("no_policy", "cannot be started")

    def test_a_program_that_babbles(self):
        self.fails("babbles", "babbled")

    def test_closed_in_the_middle(self):
        for make in (sofof.OffloadingEnv, sofof.env, sofof.parallel_env):
            env = make("toy")
            env.reset(seed=1)
            env.close()
            self.nothing_stays()

    def test_forgotten_in_the_middle(self):
        env = sofof.OffloadingEnv("toy")
        env.reset(seed=1)
        del env
        self.nothing_stays()

    def test_left_by_an_exception(self):
        with self.assertRaises(KeyError), sofof.OffloadingEnv("toy") as env:
            env.reset(seed=1)
            raise KeyError
        self.nothing_stays()

    def test_a_killed_program(self):
        env = sofof.OffloadingEnv("toy")
        env.reset(seed=1)
        env._episode._drive._started.process.kill()
        with self.assertRaises(sofof.SofofError):
            for _ in range(100):
                env.step(0)
        self.nothing_stays()


class Plain(unittest.TestCase):
    """The stand-ins for Gymnasium's spaces."""

    def test_actions(self):
        space = spaces.PlainDiscrete(3, seed=1)
        self.assertEqual({space.sample() for _ in range(99)}, {0, 1, 2})
        self.assertEqual({space.sample([0, 1, 0]) for _ in range(9)}, {1})
        for x, is_in in ((0, True), (2, True), (3, False), (-1, False),
                         (0.5, False), ("1", False), (None, False)):
            self.assertEqual(space.contains(x), is_in, x)

    def test_vectors(self):
        space = spaces.PlainBox([0.0, -1.0], [1.0, 1.0], seed=1)
        self.assertIn(space.sample(), space)
        self.assertNotIn(spaces.vector([0.0, -1.1]), space)
        self.assertNotIn(spaces.vector([0.0]), space)
        self.assertEqual(space, spaces.PlainBox([0.0, -1.0], [1.0, 1.0]))


@unittest.skipUnless(PROGRAM, "NOT TESTED: SOFOF names no program")
class Simulation(here.InFolder):
    """The real one, for some seconds."""

    SHORT = {"scenario": here.CONFIG / "bench" / "mixed_fleet.toml",
             "duration": "20s"}

    def test_rewards_repeat_and_end_in_a_safe_summary(self):
        with sofof.OffloadingEnv(**self.SHORT) as env:
            first = play(env, 3, lambda k: k % 2)
            self.assertEqual(play(env, 3, lambda k: k % 2), first)
        self.assertGreater(len(first), 6 * 15)

    def test_vehicles_that_provide_may_be_asked(self):
        world = {"scenario": here.CONFIG / "convoy.toml", "duration": "10s"}
        with sofof.OffloadingEnv(**world) as env:
            self.assertEqual(env.action_space.n, 2)
        three = {"fleet.0.provide.cars": "all", "fleet.0.count": 3,
                 "fleet.0.first_station": 90}
        with sofof.OffloadingEnv(**world, set=three) as env:
            self.assertEqual(env.action_space.n, 4)

    def test_it_conforms(self):
        conformance.check_aec(lambda: sofof.env(**self.SHORT), self)
        conformance.check_parallel(lambda: sofof.parallel_env(**self.SHORT),
                                   self)


if __name__ == "__main__":
    warnings.simplefilter("error", ResourceWarning)
    here.main()
