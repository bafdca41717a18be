"""Firefox and WebKit, as the page tests need them: open a page, run a script in it, what failed.

Firefox is asked as its own driver asks it (Marionette), WebKit through WebKitWebDriver; both come
from the system: `apt install firefox-esr webkit2gtk-driver xvfb`. No network is within their reach.
`python -m tests.engines` says loudly which of them is not there.
"""

import json
import os
import shutil
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from contextlib import ExitStack, contextmanager, suppress
from glob import glob

from tests.pages import BUILT, patience
from tests.project import listens

NOT_TESTED = "NOT TESTED in {}: apt install firefox-esr webkit2gtk-driver xvfb"
NOWHERE = "127.0.0.1:9"  # the proxy through which they would reach a network
DIRECT = urllib.request.build_opener(urllib.request.ProxyHandler({}))  # to a driver, by no proxy
# Async, as a script may wait; what it throws becomes an error here
WAITING = """const done = arguments[arguments.length - 1];
(async () => {%s})().then((value) => done({ value }), (error) => done({ error: `${error}` }));"""
# What fails from the page's first line on, before its policy, kept where a script of the driver's
# can read it; and a way to the page's own names
LISTEN = """<script>
const vmcFailed = (what) => (document.documentElement.dataset.failed =
  (document.documentElement.dataset.failed ?? "") + `${what}\n`);
addEventListener("error", ({ message, target }) =>
  vmcFailed(message ?? `no ${target.src ?? target.href}`), true);
addEventListener("unhandledrejection", (event) => vmcFailed(event.reason));
addEventListener("vmc-limit", () =>
  (vmc["python/interpreter"].limit.seconds = +document.documentElement.dataset.limit));
</script>"""


def hang():
    """How long a script or a page may take, ms: it may start Python, and these are slow at that."""
    return int(5 * patience())


class Crashed(Exception):
    """The process that shows pages has died; WebKit ends its driver's session with it."""


class Engine:
    """A browser in a folder of its own; `_start`, `_navigate` and `_script` are its driver's.

    What `_start` opens it leaves on a stack, to be closed together: where the start fails, at once.
    """

    def __init__(self, folder):
        self.folder = folder
        with ExitStack() as opened:
            self._start(opened)
            self.close = opened.pop_all().close

    def open(self, path):
        """Open a built page, whose failures are listened to."""
        copy = self.folder / "site/book" / path.name
        if not copy.parent.exists():
            copy.parent.mkdir(parents=True)
            for name in ("_static", "_images", "searchindex.js"):
                (self.folder / "site" / name).symlink_to(BUILT / name)
        copy.write_text(
            path.read_text(encoding="utf-8").replace("<head>", f"<head>{LISTEN}", 1),
            encoding="utf-8",
        )
        self._navigate(copy.as_uri())
        here = f"return location.href === {json.dumps(copy.as_uri())}"
        while not self.run(f"{here} && document.readyState === 'complete';"):
            time.sleep(0.05)  # a driver may answer before the page is there

    def run(self, text):
        """What a script returns that may wait; AssertionError with what it throws."""
        answer = self._script(WAITING % text)
        assert "error" not in answer, answer
        return answer.get("value")

    def limit(self, seconds):
        """How long the page's Python may take; Firefox's driver sees no name of a page's own."""
        self.run(f"""document.documentElement.dataset.limit = {seconds};
          dispatchEvent(new Event("vmc-limit"));""")

    def errors(self):
        return self.run("return document.documentElement.dataset.failed ?? '';")

    def restart(self):
        self.close()
        self.__init__(self.folder)


class Firefox(Engine):
    """Debian's Firefox; without a screen it has no WebGL."""

    @staticmethod
    def program():
        return shutil.which("firefox-esr") or shutil.which("firefox")

    def _start(self, opened):
        folder = self.folder
        host, port = NOWHERE.split(":")
        settings = {"marionette.port": 0, "network.proxy.type": 1}
        for kind in ("network.proxy.http", "network.proxy.ssl"):
            settings |= {kind: host, f"{kind}_port": int(port)}
        lines = [f"user_pref({json.dumps(k)}, {json.dumps(v)});\n" for k, v in settings.items()]
        (folder / "user.js").write_text("".join(lines), encoding="utf-8")
        options = "--headless --no-remote --marionette --profile"
        command = [self.program(), *options.split(), folder]
        self.process = opened.enter_context(running(command, folder / "log"))
        chosen = folder / "MarionetteActivePort"
        wait(lambda: chosen.exists() and chosen.read_bytes(), self.process)
        port = int(chosen.read_bytes())
        self.line = opened.enter_context(socket.create_connection(("127.0.0.1", port)))
        self.replies = opened.enter_context(self.line.makefile("rb"))
        self._reply()  # its greeting
        self._ask("WebDriver:NewSession")
        self._ask("WebDriver:SetTimeouts", script=hang(), pageLoad=hang())

    def _ask(self, name, **parameters):
        message = json.dumps([0, 1, name, parameters]).encode()
        self.line.sendall(b"%d:%s" % (len(message), message))
        _, _, error, answer = self._reply()
        assert not error, error
        return answer.get("value")

    def _reply(self):
        length = b"".join(iter(lambda: self.replies.read(1), b":"))
        return json.loads(self.replies.read(int(length)))

    def _navigate(self, url):
        self._ask("WebDriver:Navigate", url=url)

    def _script(self, text):
        return self._ask("WebDriver:ExecuteAsyncScript", script=text, args=[])


class WebKit(Engine):
    """WebKitGTK's own small browser, on a screen that is not there (Xvfb)."""

    @staticmethod
    def program():
        browsers = glob("/usr/lib/*/webkit2gtk-4.*/MiniBrowser")
        tools = all(map(shutil.which, ("WebKitWebDriver", "xvfb-run")))
        return browsers[0] if browsers and tools else None

    def _start(self, opened):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        driver = ["xvfb-run", "--auto-servernum", "WebKitWebDriver", f"--port={self.port}"]
        self.process = opened.enter_context(running(driver, self.folder / "log"))
        wait(lambda: listens(self.port), self.process)
        options = ["--automation", f"--proxy=http://{NOWHERE}"]
        wanted = {"webkitgtk:browserOptions": {"binary": self.program(), "args": options}}
        self.session = ""
        self.session = "/" + self._ask("", capabilities={"alwaysMatch": wanted})["sessionId"]
        self._ask("/timeouts", script=hang(), pageLoad=hang())

    def _ask(self, command, **parameters):
        address = f"http://127.0.0.1:{self.port}/session{self.session}{command}"
        kind = {"Content-Type": "application/json"}
        request = urllib.request.Request(address, json.dumps(parameters).encode(), kind)
        try:
            with DIRECT.open(request) as reply:
                return json.load(reply)["value"]
        except urllib.error.HTTPError as error:
            why = error.read().decode()
            failure = Crashed if "invalid session id" in why else AssertionError
            raise failure(f"{command}: {why}") from error

    def _navigate(self, url):
        self._ask("/url", url=url)

    def _script(self, text):
        return self._ask("/execute/async", script=text, args=[])


@contextmanager
def running(command, log):
    """A process in a group of its own, which ends with all that it started."""
    with open(log, "w", encoding="utf-8") as file:
        process = subprocess.Popen(command, stdout=file, stderr=file, start_new_session=True)
    try:
        yield process
    finally:
        with suppress(ProcessLookupError):  # all have ended by themselves
            os.killpg(process.pid, 15)
        process.wait()


def wait(ready, process):
    while not ready():
        assert process.poll() is None, process.args
        time.sleep(0.05)


if __name__ == "__main__":
    for engine in (Firefox, WebKit):
        if not engine.program():
            print(f"\n{NOT_TESTED.format(engine.__name__)}\n", file=sys.stderr)
