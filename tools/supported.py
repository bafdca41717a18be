"""Whether this project's packages exist for a machine, asked before any is installed.

`python tools/supported.py` needs nothing but some Python 3, and ends with the reason where not.
"""

import platform
import struct
import sys

OLDEST = 3, 11
GLIBC = 2, 28  # torch's and MuJoCo's
MACHINES = {
    "Linux": ("x86_64", "aarch64"),
    "Darwin": ("arm64",),
    "Windows": ("AMD64",),
}
SYSTEMS = (
    "Linux (x86-64, ARM 64; glibc 2.28 or newer, so not Alpine), macOS on Apple silicon, "
    "Windows on x86-64"
)


def problem(system, machine, libc, version, implementation="CPython", bits=64):
    """Why the packages cannot be installed, or None; `libc` is (name, version) of a Linux."""
    if version < OLDEST:
        return "Python 3.11 or newer is needed: make PYTHON=python3.11"
    if implementation != "CPython" or bits < 64:
        return "The usual Python (CPython) of 64 bits is needed, from python.org or your system"
    name, number = libc
    old = [int(part) for part in number.split(".")[:2] if part.isdigit()] < [*GLIBC]
    if machine not in MACHINES.get(system, ()) or (system == "Linux" and (name != "glibc" or old)):
        here = " ".join(
            filter(None, (system, machine, name or "musl" * (system == "Linux"), number))
        )
        return (
            f"MuJoCo, numba or torch do not exist for this Python ({here}). They do for {SYSTEMS}. "
            "The built book needs none of them: it opens in any browser"
        )
    return None


if __name__ == "__main__":
    why = problem(
        platform.system(),
        platform.machine(),
        platform.libc_ver(),
        sys.version_info[:2],
        platform.python_implementation(),
        8 * struct.calcsize("P"),
    )
    if why:
        sys.exit(why + ".")
