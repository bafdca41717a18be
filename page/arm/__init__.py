"""The arm whose physics runs in the page: MuJoCo's WebAssembly build, moved by the reader."""

from arm_in_page.live import live_arm
from arm_in_page.whole import live_whole_arm

__all__ = ["live_arm", "live_whole_arm"]
