"""Pictures of a report, still and moving, as Chromium shows it."""
import base64
import importlib.util
import io
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tests" / "report"))

import browser

SCENARIO = "ulm_lehr.toml"
FIRST_S, LAST_S, STEP_S, FRAME_MS = 60.0, 156.0, 1.6, 80
STILL_S = 70
PAGE = 1080, 800  # pixels
PLAYER_WIDTH = 940
EDGE = 12  # below the strips


def missing():
    """What this machine lacks; nothing: "" ."""
    if not browser.program():
        return "Chromium"
    return "" if importlib.util.find_spec("PIL") else "PIL (python3-pil)"


def opened(page, runs, width, height):
    folder = runs.folder_of(SCENARIO)
    file = folder.parent / "report.html"
    if not file.exists():
        subprocess.run([runs.program, "report", folder, "-o", file], check=True,
                       capture_output=True)
    page.show(width, height)
    page.open(file)
    page.run("sofof.ready")


def at(page, time_s):
    """Shows a moment, and waits until it is drawn."""
    page.run(f"sofof.players[0].clock.seek({time_s})")
    page.run("new Promise(done => requestAnimationFrame(() => "
             "requestAnimationFrame(done)))")


def shot(page, box):
    from PIL import Image

    data = page.ask("Page.captureScreenshot", clip=box | {"scale": 1},
                    captureBeyondViewport=True)["data"]
    return Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB")


def box_of(page, selector):
    return page.run(f"""(() => {{
        const one = document.querySelector("{selector}");
        const box = one.getBoundingClientRect();
        return {{x: box.left + scrollX, y: box.top + scrollY,
                 width: box.width, height: box.height}};
    }})()""")


def still(runs, file):
    """What is to be seen of the drive, with the list of what else there is."""
    with browser.Browser() as page:
        opened(page, runs, *PAGE)
        page.run('document.querySelector(".player").scrollIntoView({'
                 'block: "start", behavior: "instant"}); scrollBy(0, -70)')
        at(page, STILL_S)
        top, strips = page.run("scrollY"), box_of(page, ".timeline")
        box = {"x": 0, "y": top, "width": PAGE[0],
               "height": strips["y"] + strips["height"] + EDGE - top}
        shot(page, box).quantize(64).save(file, optimize=True)


def moving(runs, file):
    """The cars on the map, and the strips below them."""
    with browser.Browser() as page:
        opened(page, runs, PLAYER_WIDTH, 2400)
        box, strips = box_of(page, ".player"), box_of(page, ".timeline")
        box["height"] = strips["y"] + strips["height"] + EDGE - box["y"]
        frames, time_s = [], FIRST_S
        while time_s <= LAST_S:
            at(page, time_s)
            frames.append(shot(page, box))
            time_s += STEP_S
    frames[0].save(file, save_all=True, append_images=frames[1:],
                   duration=FRAME_MS, loop=0, lossless=True, method=4)


def frames_of(file):
    from PIL import Image, ImageSequence

    with Image.open(file) as picture:
        return [x.convert("RGB") for x in ImageSequence.Iterator(picture)]


def difference(one, other):
    """Mean of all pixels, of 255, of the frame that differs most; 255 where
    pictures have other sizes or lengths."""
    from PIL import ImageChops, ImageStat

    a, b = frames_of(one), frames_of(other)
    if len(a) != len(b) or a[0].size != b[0].size:
        return 255.0
    return max(sum(ImageStat.Stat(ImageChops.difference(x, y)).mean) / 3
               for x, y in zip(a, b))


MAKERS = {"report.png": still, "report.webp": moving}
