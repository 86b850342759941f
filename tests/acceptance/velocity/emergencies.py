#!/usr/bin/env python3
"""Writes velocity problems of one family: a slower car ahead, seen late.

  emergencies.py FILE COUNT SEED

The car drives 10 to 14 m/s, what it follows 3 to 5 m/s and so near that comfort
is not enough: limits of -6 m/s2 and 6 m/s3. Its distance is between just enough
and half as much again of what braking needs. Problems are in the format of
`sofof solve`, without references; some may have no answer. Format, weights and
how limits follow from a road are those of VEL160 (docs/planner.md).
"""
import json
import math
import random
import sys

STEPS, STEP_M, EPS_MPS = 160, 0.5, 0.5
A_MIN, A_MAX, JERK, A_TOTAL = -6.0, 2.5, 6.0, 6.0
GAP_M, GAP_S = 5.0, 1.2


def road(rnd):
    """-> curvature and speed limit at each knot."""
    waves = [(rnd.uniform(0, 0.008), rnd.uniform(30, 120), rnd.uniform(0, 6.3))
             for _ in range(3)]
    bend = [sum(a * math.sin(2 * math.pi * k * STEP_M / length + phase)
                for a, length, phase in waves) for k in range(STEPS + 1)]
    limit = rnd.choice([13.89, 15.0, 16.67])
    return bend, [min(limit, math.sqrt(2.0 / max(1e-4, abs(x)))) for x in bend]


def raised(w_max, w, a):
    """-> w_max where the car cannot be slower yet: a moderate braking profile
    from where it is, so that noise on its state stays correctable."""
    out, most = [], w
    for k, allowed in enumerate(w_max):
        out.append(max(allowed, most + min(0.05, 0.05 * k)))
        speed = math.sqrt(2 * max(most, 0) + EPS_MPS ** 2)
        most = max(0.0, most + STEP_M * a)
        a = max(0.6 * A_MIN, a - 0.7 * JERK * STEP_M / speed)
    return out


def wanted(w_max):
    """-> w_ref: what braking by 1.5 m/s2 can still keep to."""
    out = [max(0.5, w_max[-1])]
    for w in reversed(w_max[:-1]):
        out.append(max(0.5, min(w, out[-1] + STEP_M * 1.5)))
    return out[::-1]


def closing_m(v, a, leader):
    """-> how much nearer the car comes at full braking."""
    nearer, dt = 0.0, 0.005
    while v > leader:
        nearer += (v - leader) * dt
        a = max(A_MIN, a - JERK * dt)
        v += a * dt
    return nearer


def problem(rnd):
    bend, limit = road(rnd)
    v, a = rnd.uniform(10, 14), rnd.uniform(-1.5, 0)
    leader = rnd.uniform(3, 5)
    ahead = (GAP_M + GAP_S * leader
             + closing_m(v, a, leader) * rnd.uniform(1.0, 1.5))
    earliest = []
    for k in range(STEPS + 1):
        s = k * STEP_M
        t = (s + GAP_M - ahead) / leader + GAP_S
        if k < 14:
            t -= 0.05 * (14 - k)
        earliest.append(round(t, 9) if k >= 3 and t > 0 else None)
    free = [x * x / 2 for x in limit]
    return dict(
        family=2, family_name="approach slower leader", step=0,
        variant="emergency", continues=False, x0=[0, v * v / 2, a],
        limits=dict(a_min=A_MIN, a_max=A_MAX, j_max=JERK, a_tot=A_TOTAL),
        k_stop=None, w_max=raised(free, v * v / 2, a), w_ref=wanted(free),
        kappa=bend, t_lo=earliest, t_hi=[None] * (STEPS + 1))


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    rnd = random.Random(int(sys.argv[3]))
    with open(sys.argv[1], "w") as out:
        json.dump(dict(
            problem="velocity", name="emergencies", N=STEPS, ds_m=STEP_M,
            eps_mps=EPS_MPS, k_a_tot=6,
            weights=dict(v=0.1, a=1.0, j=1.0, terminal_m=4.0),
            tolerances=dict(violation=0.001, cost_relative=0.001),
            instances=[problem(rnd) for _ in range(int(sys.argv[2]))]), out)


if __name__ == "__main__":
    main()
