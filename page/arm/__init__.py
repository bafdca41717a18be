"""The arm whose physics runs in the page: MuJoCo's WebAssembly build, moved by the reader."""

from page.arm.live import live_arm
from page.arm.whole import live_whole_arm

__all__ = ["live_arm", "live_whole_arm"]
