"""Chromium without a window, driven as a reader would: keys, mouse, what the page then says. By its debugging protocol over
two pipes (--remote-debugging-pipe), messages in JSON that end with a zero byte; nothing but the standard library."""

import fcntl
import json
import os
import select
import shutil
import subprocess
import tempfile
import time

PROGRAM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
PATIENCE = 60  # seconds for an answer, on a busy machine


class Browser:
    """Closes with its `with` block. `webgl`: it draws in space, by the processor; otherwise pages find no
    WebGL, as in a window of a machine without graphics hardware."""

    def __init__(self, width=1200, height=1000, webgl=False):
        self._home = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        its_input, self._to = os.pipe()
        self._from, its_output = os.pipe()

        def place():  # the browser reads from descriptor 3 and writes to 4
            first, second = (fcntl.fcntl(pipe, fcntl.F_DUPFD, 10) for pipe in (its_input, its_output))
            os.dup2(first, 3)
            os.dup2(second, 4)

        self._process = subprocess.Popen(
            [
                PROGRAM,
                "--headless",
                "--no-sandbox",
                *(
                    ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
                    if webgl
                    else ["--disable-gpu", "--disable-3d-apis"]
                ),
                "--disable-dev-shm-usage",
                "--remote-debugging-pipe",
                f"--user-data-dir={self._home.name}",
                f"--window-size={width},{height}",
                "about:blank",
            ],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            env={**os.environ, "HOME": self._home.name},
            preexec_fn=place,
            close_fds=False,
        )
        os.close(its_input)
        os.close(its_output)
        self._number, self._buffer, self._session = 0, b"", None
        self.events = []
        try:
            target = self.send("Target.createTarget", url="about:blank")["targetId"]
            self._session = self.send("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
            for domain in ("Page", "Runtime", "Log", "DOM"):
                self.send(f"{domain}.enable")
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        os.close(self._to)  # it ends when nobody speaks to it
        try:
            self._process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        os.close(self._from)
        self._home.cleanup()

    def _message(self):
        end = time.monotonic() + PATIENCE
        while b"\0" not in self._buffer:
            ready, _, _ = select.select([self._from], [], [], max(0, end - time.monotonic()))
            more = os.read(self._from, 1 << 20) if ready else b""
            if not more:
                raise AssertionError("the browser has ended or does not answer")
            self._buffer += more
        text, _, self._buffer = self._buffer.partition(b"\0")
        return json.loads(text)

    def send(self, method, **parameters):
        """The result of a command of the protocol."""
        self._number += 1
        message = {"id": self._number, "method": method, "params": parameters}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._to, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._message()
            if answer.get("id") == self._number:
                if "error" in answer:
                    raise AssertionError(f"{method}: {answer['error']['message']}")
                return answer["result"]
            self.events.append(answer)

    def open(self, path, javascript=True):
        """Shows a file; its console is then in `complaints`."""
        self.send("Emulation.setScriptExecutionDisabled", value=not javascript)
        self.events.clear()
        self.send("Page.navigate", url=path.as_uri())
        while not any(event.get("method") == "Page.loadEventFired" for event in self.events):
            self.events.append(self._message())

    @property
    def complaints(self):
        """What the page has thrown or said on the console. Not what the browser's graphics say of their own speed: on a busy
        machine a test that reads pixels can make them complain of that."""
        self.evaluate("1")  # what was sent before has come by then
        methods = ("Runtime.exceptionThrown", "Runtime.consoleAPICalled", "Log.entryAdded")
        said = [event for event in self.events if event.get("method") in methods]
        return [event for event in said if "GL Driver Message (OpenGL, Performance" not in json.dumps(event)]

    def evaluate(self, expression):
        """Value of a JavaScript expression in the page."""
        answer = self.send("Runtime.evaluate", expression=expression, returnByValue=True)
        if "exceptionDetails" in answer:
            raise AssertionError(answer["exceptionDetails"])
        return answer["result"].get("value")

    def await_(self, expression):
        """Value of a promise in the page, once it is kept."""
        answer = self.send("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise AssertionError(answer["exceptionDetails"])
        return answer["result"].get("value")

    def press(self, key, code=0, text=""):
        """A key, on what has the focus."""
        for kind in ("keyDown", "keyUp"):
            self.send(
                "Input.dispatchKeyEvent",
                type=kind,
                key=key,
                code=key,
                windowsVirtualKeyCode=code,
                **({"text": text} if text and kind == "keyDown" else {}),
            )

    def mouse(self, kind, x, y, **more):
        """'Moved', 'Pressed' or 'Released', at a place of the window."""
        self.send("Input.dispatchMouseEvent", type=f"mouse{kind}", x=x, y=y, **more)

    def click(self, x, y):
        self.mouse("Moved", x, y)
        for kind in ("Pressed", "Released"):
            self.mouse(kind, x, y, button="left", buttons=1, clickCount=1)

    def drag(self, start, end):
        self.mouse("Moved", *start)
        self.mouse("Pressed", *start, button="left", buttons=1, clickCount=1)
        middle = [(a + b) / 2 for a, b in zip(start, end)]
        for place in (middle, end):
            self.mouse("Moved", *place, button="left", buttons=1)
        self.mouse("Released", *end, button="left", buttons=0, clickCount=1)

    def box(self, selector, number=0):
        """(left, top, width, height) of an element in the window, which is scrolled to show it."""
        element = f"document.querySelectorAll({json.dumps(selector)})[{number}]"
        self.evaluate(f"{element}.scrollIntoView({{block: 'center', behavior: 'instant'}})")
        found = self.evaluate(f"(r => [r.left, r.top, r.width, r.height])({element}.getBoundingClientRect())")
        return tuple(found)
