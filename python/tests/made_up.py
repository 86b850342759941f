"""A made-up run, sweep and bench for plots: two cars on a round street, one
provider. The same bytes each time, whatever the program does."""
import json
import math
import pathlib

CONFIG = """name = "made_up"
duration = "60s"
seed = 1
map = "map.toml"
[[fleet]]
count = 2
[[provider]]
name = "mec"
position_m = [100.0, 0.0]
area_radius_m = 80.0
[[service]]
name = "trajectory_planning"
max_latency = "50ms"
"""
SESSION = "station,provider,provider_id,service,counter"


def run(folder: pathlib.Path, slower_ms: float = 0.0) -> pathlib.Path:
    """Writes a results folder."""
    folder.mkdir(parents=True)
    (folder / "config.toml").write_text(CONFIG)
    ring = [[round(100 * math.cos(a / 20 * math.pi), 3),
             round(60 * math.sin(a / 20 * math.pi), 3)] for a in range(41)]
    (folder / "map.toml").write_text(
        f'name = "ring"\n[[lane]]\nname = "ring"\npoints_m = {ring}\n')
    (folder / "tracks.csv").write_text(_tracks())
    (folder / "cycles.csv").write_text(_cycles(slower_ms))
    (folder / "episodes.csv").write_text(_episodes(slower_ms))
    safety = {"without_fresh_plan_s": 0, "collisions": 0, "off_road_s": 0}
    (folder / "summary.json").write_text(json.dumps({"safety": safety}))
    return folder


def _tracks() -> str:
    lines = ["t_s,station,x_m,y_m,heading_rad,speed_mps,accel_mps2,s_m,"
             "lateral_m,plan_age_ms,source"]
    for station, phase in ((101, 0.0), (102, 2.2)):
        for k in range(61):
            a = phase + k / 15
            x, y = 100 * math.cos(a), 60 * math.sin(a)
            source = "remote" if math.dist((x, y), (100, 0)) < 80 else "local"
            lines.append(f"{k}.000000000,{station},{x:.3f},{y:.3f},{a:.6f},"
                         f"8.000,0.000,{8 * k:.3f},0.000,40.000000,{source}")
    return "\n".join(lines) + "\n"


def _cycles(slower_ms: float) -> str:
    lines = [f"{SESSION},cycle,created_s,received_s,latency_ms,input_age_ms,"
             "interarrival_ms,used,doubt_ms,uplink_wait_ms,uplink_ms,queue_ms,"
             "computing_ms,downlink_wait_ms,downlink_ms,rest_ms"]
    for k in range(400):
        latency_ms = 6 + slower_ms - 9 * math.log(1 - (k * 0.618034) % 1)
        at = k * 0.05
        lines.append(
            f"101,mec,1,trajectory_planning,1,{k},{at:.9f},"
            f"{at + latency_ms / 1000:.9f},{latency_ms:.6f},60.000000,"
            f"{'50.000000' if k else ''},{int(latency_ms <= 50)},,0.000000,"
            "1.000000,0.000000,3.000000,0.000000,2.000000,0.000000")
    return "\n".join(lines) + "\n"


def _episodes(slower_ms: float) -> str:
    lines = [f"side,{SESSION},accepted_s,first_data_s,ended_s,t_off_s,reason,"
             "fallback,because"]
    for k in range(8):
        begin, t_off = 7 * k + 1.0, 3.5 + (k * 5 % 4) - slower_ms / 10
        reason = "shutdown" if k == 7 else "left_area"
        for side in ("requester", "provider"):
            data = f"{begin:.9f}" if side == "requester" else ""
            lasted = f"{t_off:.9f}" if side == "requester" else ""
            lines.append(
                f"{side},{101 + k % 2},mec,1,trajectory_planning,{k + 1},"
                f"{begin - 0.1:.9f},{data},{begin + t_off:.9f},{lasted},"
                f"{reason},0,")
    return "\n".join(lines) + "\n"


def sweep(folder: pathlib.Path) -> pathlib.Path:
    """Writes the table of a sweep, made_up.csv."""
    folder.mkdir(parents=True)
    lines = ["point,gap,profile,seed,status,run,t_off_s.mean"]
    for gap in (60, 80, 100):
        for name, gain in (("quick", 1.0), ("slow", 0.6)):
            for seed in range(1, 7):
                mean = gain * gap / 4 + (seed * 7 % 5 - 2)
                lines.append(f"{len(lines)},{gap}ms,{name},{seed},ok,none,"
                             f"{mean:.3f}")
    (folder / "made_up.csv").write_text("\n".join(lines) + "\n")
    return folder


def bench(folder: pathlib.Path) -> pathlib.Path:
    """Writes a leaderboard."""
    folder.mkdir(parents=True)
    lines = ["scenario,place,entrant,lodm,codm,status,runs,unsafe,failed,tied,"
             "score,score_low,score_high"]
    for place, (name, score) in enumerate(
            (("mine", 0.21), ("edf", 0.23), ("location", 0.33)), 1):
        status = "below the line" if name == "location" else "ranked"
        lines.append(f"all,{place},{name},{name},edf,{status},3,0,0,0,{score},"
                     f"{score - 0.02},{score + 0.02}")
    (folder / "leaderboard.csv").write_text("\n".join(lines) + "\n")
    return folder
