#!/usr/bin/python3 -IS
"""A program that answers `check` and `run` as sofof does, of a world that is
none: three vehicles, two providers, a second at a time. For tests of what is
hard to bring about with the real one.

The variable TOY says what goes wrong: "dies" in the middle, "refuses" the
scenario, "babbles", starts "no_policy".
"""
import json
import os
import pathlib
import random
import shlex
import socket
import subprocess
import sys
import tomllib

CONFIG = """name = "toy"
[[fleet]]
count = 3
first_station = 101
connected = true
[[fleet]]
count = 1
first_station = 201
connected = false
[[provider]]
name = "near"
[[provider]]
name = "far"
[[service]]
name = "trajectory_planning"
[[service]]
name = "cabin_climate"
"""


def complain(sentence: str, code: int) -> None:
    print(f"sofof: {sentence}", file=sys.stderr)
    sys.exit(code)


def provider(number: int, users: int) -> dict:
    return {"id": number, "x_m": 40.0 * number, "y_m": 0.0,
            "utilisation": 0.4 * users, "workers": 1, "computing_s": 0.01,
            "late": 0.1, "gap": 0.0, "median_s": None, "p99_s": 0.02,
            "time_s": 0.03, "energy_j": 0.002, "gain": 0.4}


class World:
    """Where each service runs, and what is sent."""

    def __init__(self, policy, seed: int, seconds: int):
        self.lines, self.policy = policy.makefile("rw"), policy
        self.random = random.Random(seed)
        self.at = {101: None, 102: None, 103: None}
        self.n = 0
        self.seconds = seconds

    def send(self, **message) -> None:
        self.lines.write(json.dumps(message) + "\n")
        self.lines.flush()

    def ask(self, t_s: float, station: int, service: str) -> None:
        self.n += 1
        users = [list(self.at.values()).count(k) for k in (1, 2)]
        near = [provider(k, users[k - 1]) for k in (1, 2)
                if k == 1 or int(t_s) % 3]
        self.send(type="ask", n=self.n, policy="lodm", t_s=t_s, station=station,
                  service=service, current=self.at[station], since_s=0,
                  here=None,
                  speed_mps=8.0, providers=near, path=[[t_s, 0.0]],
                  needs={"period_s": 0.1, "max_latency_s": 0.05,
                         "max_interarrival_s": 0.15, "worst_response_s": None},
                  on_board={"time_s": 0.0055, "energy_j": 0.015},
                  draws=[self.random.random() for _ in range(4)],
                  a_member_of_later_versions=1)
        answer = json.loads(self.lines.readline() or complain("no answer", 1))
        if answer["n"] != self.n:
            complain("another n", 1)
        if service != "trajectory_planning":
            return
        if answer["do"] == "come_home":
            self.at[station] = None
        elif answer["do"] == "run_at":
            self.at[station] = answer["provider"]

    def drive(self) -> None:
        self.send(type="hello", sofof=1, policy="lodm", scenario="toy", seed=1)
        if not json.loads(self.lines.readline())["tells"]:
            complain("it tells nothing", 1)
        for second in range(self.seconds):
            if os.environ.get("TOY") == "dies" and second == 2:
                complain("the worker fell over.", 1)
            for k, station in enumerate(self.at):
                t_s = second + 0.1 * k + 0.05
                self.ask(t_s, station, "trajectory_planning")
                self.ask(t_s, station, "cabin_climate")
                if k == 0:  # another offer
                    self.ask(t_s + 0.02, station, "trajectory_planning")
                for _ in range(2):
                    self.send(type="told", what="cycle", t_s=t_s,
                              station=station, service="trajectory_planning",
                              computed_at=self.at[station],
                              latency_s=self.random.uniform(0.01, 0.04),
                              missed=False, energy_j=0.002, cycles=5)
        self.send(type="bye")


def main(words: list[str]) -> None:
    fault = os.environ.get("TOY", "")
    if fault == "refuses":
        complain("toy.toml:1:1: it is no good.", 2)
    if words[0] == "check":
        print(CONFIG)
        return
    changes = [w.split("=", 1) for w in words if w.startswith("policies.lodm=")]
    command = tomllib.loads("x = " + changes[0][1])["x"]["command"]
    out = pathlib.Path(words[words.index("--out") + 1])
    seed = int([w for w in words if w.startswith("--seed=")][0][7:])
    if fault == "no_policy":
        complain("the policy cannot be started.", 2)
    ours, theirs = socket.socketpair()
    child = subprocess.Popen(shlex.split(command), stdin=theirs, stdout=theirs)
    theirs.close()
    try:
        if fault == "babbles":
            ours.sendall(b"{]\n")
            complain("it babbled.", 1)
        World(ours, seed, 5).drive()
        child.wait(2)
    finally:
        child.kill()
        child.wait()
    out.mkdir()
    (out / "summary.json").write_text('{"safety": {"driven_s": 15}}')


if __name__ == "__main__":
    main(sys.argv[1:])
