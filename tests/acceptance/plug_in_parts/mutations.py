"""Runs in which one answer of a policy's program has errors.

mutations.py SOFOF SCENARIO FOLDER COUNT prints "K of COUNT as promised; ...": a
run fails with exit code 1, one sentence and no results, or the answer was still
right and the run is whole."""
import pathlib
import shutil
import subprocess
import sys

FAULTY = pathlib.Path(__file__).with_name("faulty.py")


def run(sofof, scenario, folder, seed):
    """Returns "refused", "right", or what was not as promised."""
    out = folder / "mutated"
    ask = 1 + seed % 7
    command = f"/usr/bin/python3 -S {FAULTY} mutated {ask} {seed}"
    done = subprocess.run(
        [sofof, "run", scenario, "--duration", "10s", "--quiet", "--out", out,
         "--set", f'policies.lodm={{name="process",command="{command}"}}'],
        capture_output=True, check=False)
    left = out.exists()
    whole = (out / "summary.json").exists()
    shutil.rmtree(out, ignore_errors=True)
    lines = done.stderr.decode().splitlines()
    if done.returncode == 0 and whole and not lines:
        return "right"
    if done.returncode == 1 and not left and len(lines) == 1 \
            and "policies.lodm" in lines[0] and lines[0].isprintable():
        return "refused"
    return f"seed {seed}: {done.returncode}, {lines}, {left}"


def main():
    sofof, scenario, folder, count = sys.argv[1:]
    count = int(count)
    results = {"refused": 0, "right": 0}
    for seed in range(count):
        found = run(sofof, scenario, pathlib.Path(folder), seed)
        if found in results:
            results[found] += 1
        else:
            print(found, file=sys.stderr)
    print(f"{sum(results.values())} of {count} as promised; "
          f"{results['refused']} refused")


if __name__ == "__main__":
    main()
