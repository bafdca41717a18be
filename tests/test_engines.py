"""The chapters in the two other engines: they open offline, their demos move, nothing fails."""

import os
import re
import sys
from contextlib import suppress
from pathlib import Path
from select import select

import pytest

from tests.engines import NOWHERE, Crashed, WebKit
from tests.pages import BUILT, CHAPTERS, PROBES
from tests.project import sample

pytestmark = pytest.mark.browser
DEMOS = [path for path in CHAPTERS if path.stem[0].isdigit()]

IDLE, UNSET = (f"{PROBES}; return {name}();" for name in ("idleSliders", "unsetEquations"))


@pytest.mark.parametrize("path", sample(DEMOS, "08_arm"), ids=lambda path: path.stem)
def test_a_chapter_opens_offline_and_its_demos_move(engine, path):
    try:
        assert_moves(engine, path)
    except Crashed:  # once in many runs; a page that crashes the engine does so twice
        engine.restart()
        assert_moves(engine, path)


def assert_moves(engine, path):
    engine.open(path)
    assert engine.run(IDLE) == []
    assert engine.run(UNSET) == []
    assert engine.errors() == ""


@pytest.mark.audit
def test_a_photo_leads_to_a_reach(engine):
    engine.open(BUILT / "book/your_photo.html")
    said = engine.run("""const say = document.querySelector(".vmc-eye [role=status]");
      document.querySelector(".vmc-eye [name=example]").click();
      while (!say.textContent.startsWith("Corrected")) await new Promise(requestAnimationFrame);
      return say.textContent;""")
    assert re.search(r"the hand ends [\d.]+ mm from the place seen; it began from", said)
    assert engine.errors() == ""


DRIVER = f"""#!{sys.executable}
import http.server, os, subprocess, sys
class Refusal(http.server.BaseHTTPRequestHandler):
    def do_POST(self):
        self.send_error(500, "refused")
subprocess.Popen(["sleep", "1000"], stdout=open(os.environ["ALIVE"], "w"))  # stays, as Xvfb does
http.server.HTTPServer(("127.0.0.1", int(sys.argv[-1].split("=")[1])), Refusal).serve_forever()
"""


def test_a_start_that_fails_asks_no_proxy_and_leaves_no_process(tmp_path, monkeypatch):
    (tmp_path / "xvfb-run").write_text(DRIVER, encoding="utf-8")
    (tmp_path / "xvfb-run").chmod(0o755)
    os.mkfifo(tmp_path / "alive")
    alive = os.open(tmp_path / "alive", os.O_RDONLY | os.O_NONBLOCK)
    changed = {"PATH": f"{tmp_path}:{os.environ['PATH']}", "ALIVE": f"{tmp_path}/alive"}
    for name, value in (changed | {"http_proxy": f"http://{NOWHERE}", "no_proxy": ""}).items():
        monkeypatch.setenv(name, value)
    with pytest.raises(AssertionError, match="refused"):
        WebKit(tmp_path)
    assert select([alive], [], [], 60)[0] == [alive]  # its end: nobody is left to write
    assert os.read(alive, 1) == b""
    os.close(alive)


def has_crashed(engine):
    try:
        return engine.run("return false;")
    except Crashed:
        return True
    except AssertionError:  # its driver does not know yet why there is no answer
        return False


@pytest.mark.audit
@pytest.mark.parametrize("engine", [WebKit], ids=["WebKit"], indirect=True)
def test_an_engine_that_crashed_is_noticed_and_restarts(engine):
    engine.open(DEMOS[0])
    for name in Path("/proc").glob("[0-9]*/comm"):
        with suppress(OSError):  # others come and go
            pid = int(name.parent.name)
            if os.getpgid(pid) == engine.process.pid and b"WebKitWebProces" in name.read_bytes():
                os.kill(pid, 9)
    assert any(has_crashed(engine) for _ in range(100))
    engine.restart()
    assert_moves(engine, DEMOS[0])


def test_errors_and_missing_files_are_reported(engine, tmp_path):
    page = tmp_path / "book/page.html"
    page.parent.mkdir()
    page.write_text(
        "<html><head></head><img src='nowhere.png'><script>throw 'aloud'</script>", encoding="utf-8"
    )
    engine.open(page)
    thrown, missing = engine.errors().splitlines()
    assert re.search("aloud|Script error", thrown)  # WebKit tells no more of a file's script
    assert "nowhere.png" in missing
