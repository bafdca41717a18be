"""The software bill of materials, CycloneDX 1.6: what ships, and what the commands install.

`python -m tools.bill` prints it. The vendored files come from their manifest, the Python packages
from the lock, each with its checksums; torch, which the lock leaves out, from requirements.txt.
"""

import json
import re
import tomllib

from tools.vendor import MANIFEST, ROOT

LOCKED = re.compile(r"^([\w.-]+)(?:\[.*\])?==([^\s;\\]+)(.*(?:\n +--hash=.*)*)", re.M)


def bill():
    """The bill, as JSON has it."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    book = {"type": "application", "name": project["name"], "version": project["version"]}
    vendored = [
        _component(entry["name"], entry["version"], _purl(entry["origin"]), [entry["sha256"]])
        | {"licenses": [{"license": {"name": entry["licence"]}}]}
        for entry in json.loads(MANIFEST.read_bytes())
    ]
    files = ROOT / "requirements.txt", ROOT / "constraints.txt"  # what is in both has its checksums
    found = (LOCKED.finditer(file.read_text(encoding="utf-8")) for file in files)
    locked = {match.group(1, 2): match for matches in found for match in matches}
    packages = [
        _component(name, version, f"pkg:pypi/{name}@{version}", re.findall(r":(\w{64})", match[3]))
        for (name, version), match in sorted(locked.items())
    ]
    return {
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {"component": book},
        "components": vendored + packages,
    }


def _component(name, version, purl, sums):
    """A component; where a release has a file for every system, with the checksum of each."""
    hashes = [{"alg": "SHA-256", "content": content} for content in sums]
    return {"type": "library", "name": name, "version": version, "hashes": hashes, "purl": purl}


def _purl(origin):
    """The package URL of a vendored file's origin."""
    registry, package, path = origin.split(":", 2)
    kind = {"python": "pypi", "here": "generic"}.get(registry, registry)
    return f"pkg:{kind}/{package.replace('@', '%40', package.startswith('@'))}#{path}"


if __name__ == "__main__":
    print(json.dumps(bill(), indent=1))
