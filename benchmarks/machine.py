"""What the figures were measured on: processor, compilers and flags, versions of the rivals."""

import datetime
import os
import platform
import subprocess
import tomllib
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from .build_rivals import CGAL_FLAGS, RUST_MANIFEST
from .rivals import CGAL

PACKAGES = ("crustline", "numpy", "pythoncdt", "scipy", "shapely", "triangle")
CRATES = ("spade", "delaunator")


def describe() -> dict[str, str]:
    """Return the description as lines of a table."""
    return {
        "date": datetime.date.today().isoformat(),
        "load": f"{os.getloadavg()[0]:.1f}",
        "processor": first_field("/proc/cpuinfo", "model name"),
        "last cache": last_cache(),
        "cores": str(len(os.sched_getaffinity(0))),
        "memory": f"{int(first_field('/proc/meminfo', 'MemTotal').split()[0]) / 2**20:.0f} GiB",
        "system": f"{platform.system()} {platform.release()}, Python {platform.python_version()}",
        "C++": f"{output('g++', '--version')}; {' '.join(CGAL_FLAGS)}",
        "Rust": f"{output('rustc', '--version')}; release, fat LTO, one codegen unit",
        "CGAL": output(CGAL, "version"),
        "packages": ", ".join(f"{name} {package_version(name)}" for name in PACKAGES),
        "crates": ", ".join(f"{name} {crate_version(name)}" for name in CRATES),
    }


def last_cache() -> str:
    """Return the size of the largest cache of the first core."""
    caches = sorted(Path("/sys/devices/system/cpu/cpu0/cache").glob("index*/size"))
    return caches[-1].read_text().strip() + "iB" if caches else "?"


def first_field(path: str, name: str) -> str:
    lines = Path(path).read_text().splitlines()
    return next((line.split(":", 1)[1].strip() for line in lines if line.startswith(name)), "?")


def output(*command: str) -> str:
    """Return the first line that a command prints, or a question mark."""
    try:
        printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return "?"
    return printed.partition("\n")[0]


def package_version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "absent"


def crate_version(name: str) -> str:
    lock = tomllib.loads(Path(RUST_MANIFEST).with_suffix(".lock").read_text())
    return "".join(crate["version"] for crate in lock["package"] if crate["name"] == name)
