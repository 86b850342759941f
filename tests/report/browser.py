"""Chromium without a window, driven over its DevTools pipe: no port, nothing
but the standard library."""

import base64
import fcntl
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

PATIENCE_S = 60
HIGH_DESCRIPTOR = 10  # beyond 3 and 4, which Chromium reads and writes


def program():
    """Where Chromium is; None if this machine lacks it."""
    return shutil.which("chromium") or shutil.which("chromium-browser")


def high(descriptor):
    moved = fcntl.fcntl(descriptor, fcntl.F_DUPFD, HIGH_DESCRIPTOR)
    os.close(descriptor)
    return moved


class Browser:
    """One page. What it says on its console, and what it asks the network
    for, is kept."""

    def __init__(self):
        self.errors = []
        self.requests = []
        self.loaded = False
        self.count = 0
        self.session = None
        self.pending = b""
        self.profile = tempfile.mkdtemp(prefix="sofof_browser_")
        theirs_in, self.to = (high(end) for end in os.pipe())
        self.answers, theirs_out = (high(end) for end in os.pipe())
        arguments = [
            program(), "--headless=new", "--remote-debugging-pipe",
            "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
            "--no-first-run", "--disable-background-networking",
            "--disable-component-update", "--hide-scrollbars",
            f"--user-data-dir={self.profile}", "about:blank",
        ]
        self.process = subprocess.Popen(
            ["bash", "-c", 'exec "${@:3}" 3<&"$1" 4>&"$2"', "chromium",
             str(theirs_in), str(theirs_out), *arguments],
            pass_fds=(theirs_in, theirs_out),
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(theirs_in)
        os.close(theirs_out)
        self.attach()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        try:
            self.process.wait(PATIENCE_S)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        os.close(self.to)
        os.close(self.answers)
        shutil.rmtree(self.profile, ignore_errors=True)

    def attach(self):
        targets = self.ask("Target.getTargets")["targetInfos"]
        page = next(one for one in targets if one["type"] == "page")
        self.session = self.ask("Target.attachToTarget",
                                targetId=page["targetId"],
                                flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.ask(f"{domain}.enable")

    def ask(self, method, **parameters):
        """Sends a command and waits for its answer."""
        self.count += 1
        number = self.count
        command = {"id": number, "method": method, "params": parameters}
        if self.session:
            command["sessionId"] = self.session
        text = json.dumps(command).encode() + b"\0"
        while text:
            text = text[os.write(self.to, text):]
        while True:
            message = self.message()
            if message.get("id") == number:
                break
        if "error" in message:
            raise RuntimeError(f"{method}: {message['error']['message']}")
        return message["result"]

    def message(self):
        """The next message; events leave their traces."""
        end = time.monotonic() + PATIENCE_S
        while b"\0" not in self.pending:
            left = end - time.monotonic()
            if left < 0 or not select.select([self.answers], [], [], left)[0]:
                raise TimeoutError("Chromium does not answer")
            part = os.read(self.answers, 1 << 20)
            if not part:
                raise RuntimeError("Chromium has ended")
            self.pending += part
        text, self.pending = self.pending.split(b"\0", 1)
        message = json.loads(text)
        self.note(message.get("method"), message.get("params"))
        return message

    def note(self, event, what):
        if event == "Runtime.exceptionThrown":
            details = what["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get(
                "description", details["text"]))
        elif event == "Runtime.consoleAPICalled" and what["type"] in (
                "error", "warning", "assert"):
            self.errors.append(str([one.get("value")
                                    for one in what["args"]]))
        elif event == "Log.entryAdded" and what["entry"]["level"] == "error":
            self.errors.append(what["entry"]["text"])
        elif event == "Network.requestWillBeSent":
            self.requests.append(what["request"]["url"])
        elif event == "Page.loadEventFired":
            self.loaded = True

    def show(self, width, height, dark=False, mobile=False):
        """Sets the size of the page, in CSS pixels, and the theme."""
        self.ask("Emulation.setDeviceMetricsOverride", width=width,
                 height=height, deviceScaleFactor=1, mobile=mobile)
        self.ask("Emulation.setEmulatedMedia", features=[
            {"name": "prefers-color-scheme",
             "value": "dark" if dark else "light"}])

    def open(self, file):
        self.go("file://" + os.path.abspath(file))

    def go(self, url):
        self.loaded = False
        self.ask("Page.navigate", url=url)
        while not self.loaded:
            self.message()

    def run(self, script):
        """The value of an expression, promises awaited."""
        answer = self.ask("Runtime.evaluate", expression=script,
                          returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(answer["exceptionDetails"]["exception"].get(
                "description", script))
        return answer["result"].get("value")

    def wait(self, seconds):
        """Lets the page live for a while."""
        self.run(f"new Promise(done => setTimeout(done, {seconds * 1000}))")

    def press(self, key, code, **more):
        for kind in ("keyDown", "keyUp"):
            self.ask("Input.dispatchKeyEvent", type=kind, key=key, code=code,
                     **more)

    def click(self, selector, share=0.5):
        """Clicks on an element, `share` of its width from its left."""
        x, y = self.run(f"""(() => {{
            const one = document.querySelector({json.dumps(selector)});
            one.scrollIntoView({{block: "center", behavior: "instant"}});
            const box = one.getBoundingClientRect();
            return [box.left + {share} * box.width, box.top + box.height / 2];
        }})()""")
        for kind in ("mousePressed", "mouseReleased"):
            self.ask("Input.dispatchMouseEvent", type=kind, x=x, y=y,
                     button="left", clickCount=1)

    def save_into(self, folder):
        """Downloads go there."""
        self.ask("Browser.setDownloadBehavior", behavior="allow",
                 downloadPath=os.path.abspath(folder))

    def paper(self, file):
        """The page as PDF, as a reader prints it."""
        data = self.ask("Page.printToPDF", printBackground=True,
                        preferCSSPageSize=True)["data"]
        with open(file, "wb") as to:
            to.write(base64.b64decode(data))

    def picture(self, file, whole=False):
        """A screenshot of what is in sight, or of the whole page."""
        data = self.ask("Page.captureScreenshot",
                        captureBeyondViewport=whole)["data"]
        with open(file, "wb") as to:
            to.write(base64.b64decode(data))
