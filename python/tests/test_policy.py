"""Policies as programs: what they are asked, what they answer."""
import io
import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

import here

import sofof

PROGRAM = os.environ.get("SOFOF")
README = here.PACKAGE / "README.md"
EXAMPLE = here.PACKAGE / "examples" / "most_room.py"

HELLO = {"type": "hello", "sofof": 1, "policy": "lodm", "scenario": "x",
         "seed": 4}


def ask(n: int, *providers: dict, **more) -> dict:
    return {"type": "ask", "n": n, "policy": "lodm", "t_s": 1.5, "station": 101,
            "service": "trajectory_planning", "current": None, "since_s": 0,
            "here": None, "providers": list(providers), "path": [[0, 1]],
            "speed_mps": 8, "needs": {"period_s": 0.1, "max_latency_s": 0.05},
            "on_board": {"time_s": 0.005, "energy_j": 0.01},
            "draws": [0, 0, 0, 0], **more}


def answers(policy: sofof.Policy, *messages: dict) -> list[dict]:
    lines = "".join(json.dumps(x) + "\n" for x in messages)
    out = io.StringIO()
    policy.run(io.StringIO(lines), out)
    return [json.loads(x) for x in out.getvalue().splitlines()]


class Nearest(sofof.Policy):
    def decide(self, ask):
        x, y = ask.path[0]
        return sofof.run_at(min(ask.providers, key=lambda p: (
            (p.x_m - x) ** 2 + (p.y_m - y) ** 2, p.id)), "the nearest")


class Protocol(unittest.TestCase):

    def test_it_greets_with_its_name_and_what_it_wants(self):
        self.assertEqual(answers(Nearest(), HELLO),
                         [{"sofof": 1, "name": "Nearest"}])

        class Curious(Nearest):
            name, version, forecast = "curious", "3", True

            def told(self, told):
                pass

        self.assertEqual(answers(Curious(), HELLO),
                         [{"sofof": 1, "name": "curious", "version": "3",
                           "tells": True, "forecast": True}])

    def test_another_version_of_the_protocol_is_refused(self):
        with self.assertRaisesRegex(ValueError, "version 2"):
            answers(Nearest(), {**HELLO, "sofof": 2})

    def test_it_answers_each_ask_and_stops_at_bye(self):
        far, near = ({"id": k, "x_m": x, "y_m": 0, "of_later": 1}
                     for k, x in ((1, 90), (2, 10)))
        self.assertEqual(
            answers(Nearest(), ask(1, far, near), ask(2, far), {"type": "bye"},
                    ask(3, far)),
            [{"n": 1, "do": "run_at", "provider": 2, "why": "the nearest"},
             {"n": 2, "do": "run_at", "provider": 1, "why": "the nearest"}])

    def test_all_it_can_say(self):
        self.assertEqual(sofof.stay(), {"do": "stay"})
        self.assertEqual(sofof.come_home("full"),
                         {"do": "come_home", "why": "full"})
        self.assertEqual(
            sofof.run_at(3, second=4, hedge_after_s=0.02, advantage=0.5),
            {"do": "run_at", "provider": 3, "advantage": 0.5,
             "second": {"provider": 4, "hedge_after_s": 0.02}})

    def test_what_is_asked_has_types(self):
        x = sofof.Ask.of(ask(7, {"id": 1}, here={"id": 65537, "p99_s": 0.04}))
        self.assertEqual((x.n, x.station, x.providers[0].late), (7, 101, 1))
        self.assertEqual((x.here.p99_s, x.needs.max_latency_s), (0.04, 0.05))
        self.assertEqual(x.raw["n"], 7)

    def test_it_is_told_what_came_of_it(self):
        heard = []

        class Listener(Nearest):
            def told(self, told):
                heard.append((told.what, told.latency_s, told.missed))

        answers(Listener(), {"type": "told", "what": "cycle", "t_s": 1,
                             "station": 1, "service": "x", "computed_at": None,
                             "latency_s": None, "missed": True, "energy_j": 0,
                             "cycles": 1})
        self.assertEqual(heard, [("cycle", None, True)])

    def test_a_provider_says_yes_or_no_to_each_request(self):
        class EveryOther(sofof.Policy):
            def decide(self, ask):
                return [k % 2 == 0 for k in range(len(ask.requests))]

        self.assertEqual(
            answers(EveryOther(), {"type": "ask", "n": 1, "policy": "codm",
                                   "requests": [{}, {}], "sessions": []}),
            [{"n": 1, "requests": [{"accept": True}, {"accept": False}]}])

    def test_a_decision_that_is_none_is_an_error(self):
        class Silent(sofof.Policy):
            def decide(self, ask):
                return None

        with self.assertRaisesRegex(ValueError, "Silent.decide returned None"):
            answers(Silent(), ask(1))

    def test_the_readme_prints_the_example(self):
        code = re.search(r"```python\n(\"\"\"Offloads.*?)```",
                         README.read_text("utf-8"), re.S)[1]
        self.assertEqual(code, EXAMPLE.read_text("utf-8"))
        lines = [x for x in code.splitlines() if x and not x.startswith('"')]
        self.assertEqual(len(lines), 9)

    def test_the_example_answers_as_a_process(self):
        lines = [HELLO, ask(1), ask(2, {"id": 1, "utilisation": 0.5},
                                    {"id": 2, "utilisation": 0.1}),
                 ask(3, {"id": 1, "utilisation": 0.95}), {"type": "bye"}]
        done = subprocess.run(
            [sys.executable, EXAMPLE], text=True, capture_output=True,
            input="".join(json.dumps(x) + "\n" for x in lines), check=True)
        said = [json.loads(x) for x in done.stdout.splitlines()]
        self.assertEqual(said[0], {"sofof": 1, "name": "MostRoom",
                                   "version": "1"})
        self.assertEqual([x["do"] for x in said[1:]],
                         ["stay", "run_at", "stay"])
        self.assertEqual(said[2]["provider"], 2)

    def test_what_it_prints_is_no_answer(self):
        script = ("import sofof\nclass P(sofof.Policy):\n"
                  "    def decide(self, ask):\n        print('thinking')\n"
                  "        return sofof.stay()\nP().run()\n")
        done = subprocess.run([sys.executable, "-c", script], text=True,
                              input=json.dumps(ask(1)) + "\n",
                              capture_output=True, check=True)
        self.assertEqual(done.stdout, '{"n":1,"do":"stay"}\n')
        self.assertEqual(done.stderr, "thinking\n")


@unittest.skipUnless(PROGRAM, "NOT TESTED: SOFOF names no program")
class Simulation(here.InFolder):

    def test_the_example_drives(self):
        run = sofof.run(here.CONFIG / "bench" / "mixed_fleet.toml",
                        set={"policies.lodm": sofof.process(EXAMPLE)},
                        duration="20s", out=self.folder / "r")
        self.assertTrue(run.safe)
        self.assertGreater(run.summary["offloaded_share"], 0.1)

    def test_a_script_with_a_mistake_is_an_exception(self):
        script = self.folder / "broken.py"
        script.write_text("import sofof\nclass P(sofof.Policy):\n"
                          "    def decide(self, ask):\n        return 1 / 0\n"
                          "P().run()\n")
        with self.assertRaises(sofof.SofofError) as caught:
            sofof.run(here.CONFIG / "bench" / "mixed_fleet.toml",
                      set={"policies.lodm": sofof.process(script)},
                      duration="20s", out=self.folder / "r")
        self.assertEqual(caught.exception.exit_code, 1)
        self.assertFalse((self.folder / "r" / "summary.json").exists())


if __name__ == "__main__":
    here.main()
