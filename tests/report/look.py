"""Opens a report and tells in numbers what a reader would see."""

import csv
import json
import os
import time

from browser import Browser

PHONE = 375  # CSS pixels
SPEED_POLL_S = 0.1

# Positions by station, of the first map of all.
POSITIONS = """Object.fromEntries(sofof.players[0].vehicles()[0].map(
    one => [one.station, [one.x, one.y]]))"""


def rows_of(folder, name):
    file = os.path.join(folder, name)
    if not os.path.exists(file):
        return []
    with open(file, newline="") as text:
        return list(csv.DictReader(text))


def moved(before, after):
    """How many vehicles have gone elsewhere, and all that were there."""
    both = before.keys() & after.keys()
    return sum(before[one] != after[one] for one in both), len(both)


def points_of_load(rows):
    """What was asked for, and the mean and the longest wait where any job
    came."""
    return len(rows) + 2 * sum(one["mean_wait_ms"] != "" for one in rows)


def points_of_octets(rows):
    """One for each second in which anything was sent, and where a pause has its
    first and its last second."""
    seconds = {}
    for one in rows:
        of = one["provider"], one["direction"], one["what"]
        seconds.setdefault(of, []).append(int(one["t_s"]))
    return len(rows) + sum(min(later - sooner - 1, 2) for of in seconds.values()
                           for sooner, later in zip(of, of[1:]))


def look(report, folder):
    """Numbers by name: what the page shows beside what the folder says."""
    cycles = rows_of(folder, "cycles.csv")
    with Browser() as page:
        page.show(1280, 900)
        page.open(report)
        page.run("sofof.ready")
        page.wait(0.1)
        paint = page.run("performance.getEntriesByName("
                         "'first-contentful-paint')[0].startTime")
        seen = {
            "size_mb": os.path.getsize(report) / 1e6,
            "first_paint_ms": paint,
        }
        at_first = page.run(POSITIONS)
        page.click(".controls input[type=range]", 0.6)
        scrubbed_to = page.run("sofof.players[0].clock.time")
        scrubbed = page.run(POSITIONS)
        page.press(" ", "Space", windowsVirtualKeyCode=32, text=" ")
        end = time.monotonic() + 20
        while (time.monotonic() < end and page.run(
                f"sofof.players[0].clock.time < {scrubbed_to} + 5")):
            page.wait(SPEED_POLL_S)
        page.press(" ", "Space", windowsVirtualKeyCode=32, text=" ")
        paused_at = page.run("sofof.players[0].clock.time")
        played = page.run(POSITIONS)
        page.wait(SPEED_POLL_S)
        seen |= {
            "vehicles": len(at_first),
            "moved_by_scrubbing": moved(at_first, scrubbed)[0],
            "moved_by_playing": moved(scrubbed, played)[0],
            "stands_when_paused":
                int(page.run("sofof.players[0].clock.time") == paused_at),
            "scrubbed_share":
                scrubbed_to / page.run("sofof.players[0].clock.until"),
        }
        page.press("ArrowRight", "ArrowRight")
        seen["arrow_steps_s"] = (
            page.run("sofof.players[0].clock.time") - paused_at)
        page.run("sofof.draw_all()")
        points = page.run("""sofof.charts.filter(
            chart => !/speed|vehicles|t_off/.test(chart.title)).flatMap(
            chart => Object.values(chart.points)).reduce((a, b) => a + b, 0)""")
        gaps = [one for one in cycles if one["interarrival_ms"]]
        ages = [one for one in cycles if one["input_age_ms"]]
        seen |= {
            "points": points,
            # Each quantity by time and as a distribution; load, waits and
            # octets by time, these with the ends of pauses.
            "csv_rows": 2 * (len(cycles) + len(gaps) + len(ages))
            + points_of_load(rows_of(folder, "load.csv"))
            + points_of_octets(rows_of(folder, "octets.csv")),
            "track_points":
                page.run("sofof.players[0].track_rows[0]"),
            "track_rows": len(rows_of(folder, "tracks.csv")),
        }
        page.show(PHONE, 800, mobile=True)
        page.wait(0.3)
        seen |= {
            "wider_than_phone_px": page.run(
                f"document.documentElement.scrollWidth - {PHONE}"),
            "console_errors": len(page.errors),
            "requests": len([one for one in page.requests
                             if not one.startswith(("file:", "data:"))]),
        }
        return seen, page.errors
