"""Which browser opens pages: the system's Chromium, else Playwright's own.

`python -m tools.browser` installs Playwright's where the system has none. Where neither can
be had it says so loudly; in continuous integration (CI=true) that is a failure.
"""

import os
import shutil
import subprocess
import sys
from contextlib import contextmanager

# The first is Chromium without the parts that draw a window: a fifth quicker
SYSTEM = (
    *("chromium-headless-shell", "chromium", "chromium-browser"),
    *("google-chrome", "google-chrome-stable"),
)
# WebGL in software: the arm is drawn on machines without a graphics card too; the page around it
# is put together without WebGL, which is twice as quick there. A graphics process that dies, for
# want of memory or time, is started again, and the pages opened after it have WebGL as before
FLAGS = (
    "--disable-quic --no-first-run --disable-background-networking "
    "--disable-component-update --disable-sync "
    "--use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader --disable-gpu-compositing "
    "--disable-gpu-watchdog --disable-gpu-process-crash-limit --disable-domain-blocking-for-3d-apis"
).split()
MISSING = (
    "NO BROWSER: the built pages are NOT tested. Install Chromium (apt install chromium), or let "
    "Playwright fetch its own (playwright install chromium)."
)


def find():
    """Path of a browser's program, or None."""
    for name in SYSTEM:
        if path := shutil.which(name):
            return path
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        path = playwright.chromium.executable_path
    return path if os.path.exists(path) else None


def options(path):
    """How Playwright launches the browser at `path`: in its sandbox, wherever it starts in one.

    As root, and in a container without user namespaces, it does not.
    """
    command = [path, "--headless", *FLAGS, "--dump-dom", "about:blank"]
    sandbox = subprocess.run(command, capture_output=True).returncode == 0
    return {"executable_path": path, "args": FLAGS, "chromium_sandbox": sandbox}


@contextmanager
def launch(*flags):
    """Launch the browser by Playwright, with `flags` besides: it closes where the block ends."""
    from playwright.sync_api import sync_playwright

    how = options(find())
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(**how | {"args": [*FLAGS, *flags]})
        yield chromium
        chromium.close()


def main():
    """Install a browser where there is none, or say loudly that there is none."""
    if not find():
        subprocess.run([sys.executable, "-m", "playwright", "install", "chromium"], check=False)
    if not find():
        print(f"\n{MISSING}\n", file=sys.stderr)
        sys.exit(bool(os.environ.get("CI")))


if __name__ == "__main__":
    main()
