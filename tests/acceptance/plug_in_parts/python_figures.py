"""What tests/acceptance/plug_in measures of python/sofof, for the program of
the variable SOFOF: prints a name, a tab and a figure a line.

  python_figures.py speed SCENARIO SECONDS
  python_figures.py together SCENARIO SECONDS
  python_figures.py left SCENARIO
  python_figures.py train TABLE
  python_figures.py rank TABLE FOLDER SEEDS
"""
import importlib.util
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import sofof

AGENT = (pathlib.Path(__file__).resolve().parents[3] / "python" / "examples"
         / "tabular_agent.py")
SEEDS = range(4)


def tell(name: str, figure: object) -> None:
    print(f"{name}\t{figure}", flush=True)


def cpu_s() -> float:
    """Of this process and of all of its children that have ended."""
    return sum(x.ru_utime + x.ru_stime for x in map(
        resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)))


def play(env, seed: int) -> list[float]:
    """Rewards of an episode; the action changes from step to step."""
    env.reset(seed=seed)
    rewards, over, n = [], False, env.action_space.n
    while not over:
        _, reward, _, over, _ = env.step(len(rewards) // 7 % n)
        rewards.append(reward)
    return rewards


def play_in_turn(env) -> int:
    env.reset(seed=1)
    steps = 0
    for agent in env.agent_iter():
        _, _, _, over, _ = env.last()
        n = env.action_space(agent).n
        env.step(None if over else steps // 7 % n)
        steps += not over
    return steps


def play_at_once(env) -> int:
    env.reset(seed=1)
    steps = 0
    while env.agents:
        env.step({x: steps // 7 % env.action_space(x).n for x in env.agents})
        steps += env.num_agents
    return steps


def speed(scenario: str, seconds: str) -> None:
    for name, make, drive in (
            ("OffloadingEnv", sofof.OffloadingEnv, lambda e: len(play(e, 1))),
            ("env", sofof.env, play_in_turn),
            ("parallel_env", sofof.parallel_env, play_at_once)):
        env = make(scenario, duration=float(seconds))
        before = cpu_s()
        steps = drive(env)
        env.close()
        tell(name, round(steps / (cpu_s() - before)))


def together(scenario: str, seconds: str) -> None:
    envs = [sofof.OffloadingEnv(scenario, duration=float(seconds))
            for _ in SEEDS]
    alone = [play(envs[0], seed) for seed in SEEDS]
    again = [play(envs[0], seed) for seed in SEEDS]
    tell("again", f"{sum(map(list.__eq__, alone, again))} of {len(SEEDS)}")
    tell("other", f"{sum(x != alone[0] for x in alone[1:])} of "
                  f"{len(SEEDS) - 1}")
    n = envs[0].action_space.n
    rewards: list[list[float]] = [[] for _ in SEEDS]
    for seed, env in zip(SEEDS, envs):
        env.reset(seed=seed)
    on_the_road = list(SEEDS)
    while on_the_road:
        for k in list(on_the_road):
            _, reward, _, over, _ = envs[k].step(len(rewards[k]) // 7 % n)
            rewards[k].append(reward)
            if over:
                on_the_road.remove(k)
    tell("same", f"{sum(map(list.__eq__, alone, rewards))} of {len(SEEDS)}")
    for env in envs:
        env.close()


def left(scenario: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        tempfile.tempdir = folder
        before = len(os.listdir("/proc/self/fd"))
        for end in ("close", "exception", "forgotten", "kill"):
            env = sofof.OffloadingEnv(scenario, duration="20s")
            env.reset(seed=1)
            if end == "close":
                env.close()
            elif end == "exception":
                try:
                    with env:
                        raise KeyError
                except KeyError:
                    pass
            elif end == "kill":
                env._episode._drive._started.process.kill()
                try:
                    while True:
                        env.step(0)
                except sofof.SofofError:
                    pass
            env = None
        killed_parent(scenario, folder)
        tempfile.tempdir = None
        running = subprocess.run(["ps", "-eo", "args"], text=True,
                                 capture_output=True).stdout
        tell("processes", sum(folder in x for x in running.splitlines()))
        tell("files", len(os.listdir("/proc/self/fd")) - before
             + sum(x.is_socket() for x in pathlib.Path(folder).rglob("*")))
    known = [x for x in ("gymnasium", "pettingzoo")
             if importlib.util.find_spec(x)]
    tell("checkers", "used: " + ", ".join(known) if known
         else "not in Debian: ours instead")


def killed_parent(scenario: str, folder: str) -> None:
    """An environment whose own process is killed: the run ends by itself."""
    script = ("import sofof, sys, time\n"
              f"e = sofof.OffloadingEnv({scenario!r})\n"
              "e.reset(seed=1)\nprint('on', flush=True)\ntime.sleep(60)\n")
    child = subprocess.Popen([sys.executable, "-c", script], text=True,
                             stdout=subprocess.PIPE,
                             env={**os.environ, "TMPDIR": folder})
    child.stdout.readline()
    child.kill()
    child.wait()
    child.stdout.close()
    time.sleep(3)


def train(table: str) -> None:
    begin = time.monotonic()
    said = subprocess.run([sys.executable, AGENT, "train", table], text=True,
                          stdout=subprocess.PIPE, check=True).stdout
    tell("seconds", round(time.monotonic() - begin, 1))
    tell("episodes", sum(x.startswith("episode") for x in said.splitlines()))


def rank(table: str, folder: str, seeds: str) -> None:
    subprocess.run([sys.executable, AGENT, "rank", table, "--seeds", seeds,
                    "--out", folder], stdout=subprocess.DEVNULL, check=True)
    rows = sofof.Leaderboard(folder).of("all")
    for _, row in rows.iterrows():
        tell(row["entrant"], f"{row['score']:.4f}")
        for end in ("low", "high"):
            tell(f"{row['entrant']}_{end}", row[f"score_{end}"])
    tell("unsafe", rows["unsafe"].sum() + rows["failed"].sum())


if __name__ == "__main__":
    globals()[sys.argv[1]](*sys.argv[2:])
