"""The arm whose physics runs in the page: MuJoCo's WebAssembly build, moved by the reader."""

from arm_in_page.live import live_arm

__all__ = ["live_arm"]
