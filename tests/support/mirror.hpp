// A program for policies that are processes: it decides as LODM "nearest" does.
#pragma once

namespace sofof::test {

/// In Python, without anything but its standard library.
inline constexpr auto mirror_of_nearest = R"(import json
import sys


def answer(ask):
    if not ask["providers"] or not ask["path"]:
        return {"do": "stay", "why": "nobody comes into question"}
    x, y = ask["path"][0]
    best = min(ask["providers"],
               key=lambda p: (p["x_m"] - x) ** 2 + (p["y_m"] - y) ** 2)
    return {"do": "run_at", "provider": best["id"], "why": "the nearest"}


for line in sys.stdin:
    said = json.loads(line)
    if said["type"] == "hello":
        reply = {"sofof": 1, "name": "mirror", "version": "1"}
    elif said["type"] == "ask":
        reply = {"n": said["n"], **answer(said)}
    else:
        continue
    print(json.dumps(reply), flush=True)
)";

} // namespace sofof::test
