"""What tests/acceptance/faults finds, held to drives that are made up."""

import importlib.machinery
import importlib.util
import json
import os
import pathlib
import sys
import tempfile
import unittest

TOOLS = pathlib.Path(__file__).resolve().parents[1] / "acceptance" / "fault"
sys.path.insert(0, str(TOOLS))
loader = importlib.machinery.SourceFileLoader("figures", str(TOOLS / "figures"))
spec = importlib.util.spec_from_loader(loader.name, loader)
figures = importlib.util.module_from_spec(spec)
loader.exec_module(figures)

ZERO = 1_000_000.0  # time of day at the drive's time 0
SERVICE = "trajectory_planning"


def steps(begin, end, width):
    return [begin + k * width for k in range(round((end - begin) / width))]


class Story:
    """A drive of one car: results each 50 ms from 1 s on, until they stop, then
    its own plan."""

    def __init__(self):
        self.results = steps(1.0, 5.0, 0.05)
        self.latency_ms = 1.0
        self.own_at = 5.03
        self.tracks = [(t, 10.0) for t in steps(0.02, 8.0, 0.02)]
        self.fault = {"kind": "kill_edge", "begin": 5.0, "mended": 5.5,
                      "end": 8.0, "again": True}
        self.stalls = []
        self.console = ""

    def write(self, folder):
        drive = folder / "0" / "car_0001"
        drive.mkdir(parents=True)
        (drive / "config.toml").touch()
        os.utime(drive / "config.toml", (ZERO, ZERO))
        (drive.parent / "car_0001.log").write_text(self.console)
        head = "station,service,used,received_s,latency_ms,input_age_ms\n"
        (drive / "cycles.csv").write_text(head + "".join(
            f"101,{SERVICE},1,{t},{self.latency_ms},20\n" for t in self.results))
        (drive / "tracks.csv").write_text("t_s,station,plan_age_ms\n" + "".join(
            f"{t:.2f},101,{age}\n" for t, age in self.tracks) + "8.3")
        events = [("switch", "remote", 1.0)]
        if self.own_at:
            events += [("switch", "local", self.own_at - 0.001),
                       ("plan_switch", "local d_m=0", self.own_at)]
        (drive / "events.jsonl").write_text("".join(json.dumps({
            "what": what, "detail": detail, "t_s": t, "station": 101,
            "service": SERVICE}) + "\n" for what, detail, t in events))
        times = {x: self.fault[x] + ZERO for x in ("begin", "mended", "end")}
        (folder / "faults.jsonl").write_text(json.dumps(
            {"pair": 0, "car": "car_0001", **self.fault, **times}) + "\n")
        (folder / "stalls.log").write_text("".join(
            f"{a + ZERO} {b + ZERO}\n" for a, b in self.stalls))

    def figures(self):
        with tempfile.TemporaryDirectory() as folder:
            self.write(pathlib.Path(folder))
            return dict(figures.Judge(pathlib.Path(folder)).figures())


class Faults(unittest.TestCase):

    def setUp(self):
        self.story = Story()

    def test_the_way_back_is_from_the_last_result_to_the_own_plan(self):
        found = self.story.figures()
        self.assertEqual(found["stopped"], 1)
        self.assertEqual(found["back.max"], "80.0")

    def test_a_result_that_was_used_before_its_switch_is_one_more(self):
        self.story.results = steps(1.05, 5.0, 0.05)
        self.assertEqual(self.story.figures()["back.max"], "80.0")

    def test_results_that_stop_with_no_own_plan_are_a_silence(self):
        self.story.own_at = None
        self.story.results.append(5.4)
        found = self.story.figures()
        self.assertEqual(found["stopped"], 0)
        self.assertEqual(found["silent.max"], "450.0")

    def test_what_a_stall_of_the_machine_held_up_is_counted_apart(self):
        self.story.own_at = 5.4
        self.story.stalls = [(5.05, 5.35)]
        found = self.story.figures()
        self.assertEqual((found["stopped"], found["stalled.stopped"]), (0, 1))
        self.assertEqual(found["stalled.back.max"], "450.0")
        self.assertEqual(found["stalled.ours"], "150.0")

    def test_a_stopped_car_counts_from_its_continuation(self):
        self.story.fault.update(kind="stop_car", begin=5.0, mended=6.0)
        self.story.own_at = 6.03
        self.story.tracks = [
            (t, 10.0 if t < 5 or t > 6.03 else 1e3 * (t - 4.95))
            for t, _ in self.story.tracks]
        found = self.story.figures()
        self.assertEqual(found["car.max"], "30.0")
        self.assertEqual(found["ours_s"], "0.00")

    def test_an_own_plan_may_seem_to_come_before_the_continuation(self):
        self.story.fault.update(kind="stop_car", begin=5.0, mended=6.001)
        self.story.own_at = 6.0
        self.assertEqual(self.story.figures()["car.max"], "0.0")

    def test_a_revoked_peer_that_goes_on_is_never_out(self):
        self.story.fault["kind"] = "revoke_edge"
        self.story.own_at = None
        self.assertEqual(self.story.figures()["revoked.max"], "inf")

    def test_an_own_plan_counts_from_the_cut_of_the_way_up(self):
        self.story.fault.update(kind="cut_up", begin=4.6, mended=5.5)
        found = self.story.figures()
        self.assertEqual((found["up.stopped"], found["up.max"]), (1, "430.0"))

    def test_an_old_plan_is_found(self):
        self.story.tracks[300:305] = [
            (t, 210.0) for t, _ in self.story.tracks[300:305]]
        self.assertEqual(self.story.figures()["ours_s"], "0.10")

    def test_the_console_tells_of_a_car_whose_disk_is_full(self):
        self.story.fault.update(kind="fill_car", told=1, code=1)
        self.story.console = ("safety\n  without a fresh plan     0.420 s   "
                              "VIOLATED\n  off the road   0.000 s\n"
                              "  collisions      0   ok\n")
        self.assertEqual(self.story.figures()["summary.without_plan"], "0.42")

    def test_a_car_that_starts_has_no_plan_yet(self):
        self.story.tracks[:15] = [
            (t, 1e3 * t) for t, _ in self.story.tracks[:15]]
        found = self.story.figures()
        self.assertEqual((found["ours_s"], found["starting_s"]),
                         ("0.00", "0.10"))

    def test_what_a_killed_car_has_not_written_is_missing(self):
        self.story.fault.update(kind="kill_car", begin=8.0)
        self.story.own_at = None
        self.story.results = steps(1.0, 6.8, 0.05)
        self.assertEqual(self.story.figures()["missing.max"], "1.25")

    def test_a_line_that_is_not_there_is_a_hole(self):
        self.story.fault.update(kind="kill_car", begin=8.0)
        del self.story.tracks[100]
        self.assertEqual(self.story.figures()["holes"], 1)

    def test_a_result_that_is_too_old_must_not_be_used(self):
        self.story.latency_ms = 50.1
        self.assertEqual(self.story.figures()["too_old"],
                         len(self.story.results))


if __name__ == "__main__":
    unittest.main()
