"""A headless Chromium driven through DevTools over a pipe: no port, no library."""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time


def browser():
    """The browser's command, or None."""
    return next((c for c in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if c), None)


class Browser:
    def __init__(self, width=1400, height=1500, dark=False):
        self.profile = tempfile.mkdtemp(prefix="gonio-browser-")
        commands, self.send_to = os.pipe()
        self.read_from, answers = os.pipe()

        def as_three_and_four():
            # Away from 3 and 4 first: one may be where the other is to go.
            a, b = os.dup(commands), os.dup(answers)
            os.dup2(a, 3)
            os.dup2(b, 4)

        self.process = subprocess.Popen(
            [browser(), "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
             "--disable-component-update", "--disable-sync", "--hide-scrollbars", "--remote-debugging-pipe",
             f"--user-data-dir={self.profile}", f"--window-size={width},{height}", "about:blank"],
            close_fds=False, preexec_fn=as_three_and_four, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(commands)
        os.close(answers)
        self.number, self.bytes, self.events, self.session = 0, b"", [], None
        target = self("Target.createTarget", url="about:blank")["targetId"]
        self.session = self("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self(f"{domain}.enable")
        self("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        if dark:
            self("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        shutil.rmtree(self.profile, ignore_errors=True)

    def _message(self, until):
        while b"\0" not in self.bytes:
            if not select.select([self.read_from], [], [], max(until - time.monotonic(), 0))[0]:
                raise TimeoutError("the browser does not answer")
            part = os.read(self.read_from, 1 << 20)
            if not part:
                raise EOFError("the browser has ended")
            self.bytes += part
        one, self.bytes = self.bytes.split(b"\0", 1)
        return json.loads(one)

    def __call__(self, method, **parameters):
        """Calls a method of DevTools; what the browser tells meanwhile is kept in events."""
        self.number += 1
        call = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            call["sessionId"] = self.session
        os.write(self.send_to, json.dumps(call).encode() + b"\0")
        until = time.monotonic() + 60
        while True:
            message = self._message(until)
            if message.get("id") != self.number:
                self.events.append(message)
            elif "error" in message:
                raise RuntimeError(f"{method}: {message['error']['message']}")
            else:
                return message["result"]

    def open(self, url, ready):
        self("Page.navigate", url=url)
        self.wait(ready)

    def ask(self, expression):
        """Value of JavaScript in the page; a promise is waited for."""
        answer = self("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(answer["exceptionDetails"].get("exception", {}).get("description", expression))
        return answer["result"].get("value")

    def wait(self, condition, seconds=30):
        until = time.monotonic() + seconds
        while True:
            try:
                if self.ask(f"Boolean({condition})"):
                    return
            except RuntimeError:  # the page is not there yet
                pass
            if time.monotonic() > until:
                raise TimeoutError(f"{condition} has not come true")
            time.sleep(0.02)

    def mouse(self, kind, x, y, pressed=False):
        self("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left" if pressed or kind != "mouseMoved" else "none",
             buttons=1 if pressed else 0, clickCount=0 if kind == "mouseMoved" else 1)

    def key(self, kind, key):
        self("Input.dispatchKeyEvent", type=kind, key=key, code=f"Key{key.upper()}" if len(key) == 1 else key,
             windowsVirtualKeyCode={"ArrowLeft": 37, "ArrowRight": 39, "ArrowDown": 40}.get(key, ord(key.upper()[0])))

    def screenshot(self, path, whole=False):
        picture = self("Page.captureScreenshot", captureBeyondViewport=whole)["data"]
        with open(path, "wb") as out:
            out.write(base64.b64decode(picture))

    def problems(self, own):
        """What went wrong or out: messages of the console, errors, and requests for anything but the page itself."""
        found = []
        for e in self.events:
            method, p = e.get("method"), e.get("params", {})
            if method == "Runtime.consoleAPICalled":
                found.append("console: " + " ".join(str(a.get("value", a.get("description"))) for a in p["args"]))
            elif method == "Runtime.exceptionThrown":
                found.append("error: " + p["exceptionDetails"].get("exception", {}).get("description", p["exceptionDetails"]["text"]))
            elif method == "Log.entryAdded" and "willReadFrequently" not in p["entry"]["text"]:  # it is the test that reads pictures
                found.append("log: " + p["entry"]["text"])
            elif method == "Network.requestWillBeSent" and not p["request"]["url"].startswith((own, "data:", "about:", "blob:")):
                found.append("request: " + p["request"]["url"][:200])
        return found
