"""Check that what crustline rests on in Python has a license that may be, and is pinned.

    python -m requirements.audit

Walks from crustline through its extras, as installed, and prints the licenses. Fails if one is not
known or not allowed, and if `ci.txt` does not pin what pyproject.toml asks for: `make lock` does.
"""

from __future__ import annotations

import re
import sys
import tomllib
from collections.abc import Iterator
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from pathlib import Path

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parent.parent
LOCK = ROOT / "requirements" / "ci.txt"

#: What a license may be. None of these asks anything of who uses crustline, MPL only of who
#: changes the package itself.
ALLOWED = re.compile(
    r"0BSD|Apache|BSD|CC0|CNRI|HPND|ISC|\bMIT\b|MIT-CMU|MPL|Mozilla Public|PSF|Python Software"
    r"|Python-2\.0|Unlicense|Zlib",
    re.IGNORECASE,
)
FORBIDDEN = re.compile(r"\bA?GPL|Affero|\bGNU General", re.IGNORECASE)
#: Licenses that a package's metadata do not say, read from its files.
READ = {"resvg_py": "MIT"}
#: Extras for developers alone.
FOR_TESTS = {"test"}


def extras() -> dict[str, list[Requirement]]:
    """Return what pyproject.toml asks for, by extra; "" is what is always needed."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    found = {"": project["dependencies"], **project["optional-dependencies"]}
    return {extra: [Requirement(each) for each in every] for extra, every in found.items()}


def walk(asked: list[Requirement], known: dict[str, list[Requirement]]) -> Iterator[Distribution]:
    """Yield the distributions that requirements lead to."""
    waiting, seen = list(asked), set()
    while waiting:
        one = waiting.pop()
        key = (canonicalize_name(one.name), *sorted(one.extras))
        if key[0] == "crustline":
            waiting += [each for extra in one.extras for each in known[extra]]
        elif key not in seen:
            seen.add(key)
            made = distribution(one.name)
            yield made
            waiting += [
                each for each in map(Requirement, made.requires or []) if _applies(each, one)
            ]


def _applies(inner: Requirement, outer: Requirement) -> bool:
    chosen = outer.extras or {""}
    return inner.marker is None or any(inner.marker.evaluate({"extra": each}) for each in chosen)


def license_of(made: Distribution) -> str:
    """Return what a distribution says of its license, in a line."""
    about = made.metadata
    classified = [each for each in about.get_all("Classifier", []) if each.startswith("License")]
    said = about.get("License-Expression") or "; ".join(
        each.rpartition(" :: ")[2] for each in classified if not each.endswith("OSI Approved")
    )
    plain = (about.get("License") or "").strip().split("\n")[0]
    return READ.get(about["Name"], said or plain)[:70]


def faults() -> Iterator[str]:
    """Yield what is wrong, and print the licenses on the way."""
    known = extras()
    product = [each for extra, every in known.items() if extra not in FOR_TESTS for each in every]
    try:
        needed = {made.metadata["Name"]: made for made in walk(product, known)}
        tools = {made.metadata["Name"]: made for made in walk(known["test"], known)}
    except PackageNotFoundError as error:
        yield f"{error.name} is not installed: run make audit where ci.txt is installed"
        return
    for name, made in sorted((tools | needed).items(), key=lambda item: item[0].lower()):
        found = license_of(made)
        print(f"{name:28} {made.version:16} {'' if name in needed else 'tests':6} {found}")
        if not ALLOWED.search(found) or (name in needed and FORBIDDEN.search(found)):
            yield f"{name} has the license {found!r}: do without it, or let audit.py say why"
    yield from unpinned(known)


def unpinned(known: dict[str, list[Requirement]]) -> Iterator[str]:
    """Yield the requirements of pyproject.toml that ci.txt does not pin."""
    pins = dict(re.findall(r"^([\w.-]+)==(\S+)", LOCK.read_text(), re.MULTILINE))
    pinned = {canonicalize_name(name): version for name, version in pins.items()}
    for each in {one for every in known.values() for one in every if one.name != "crustline"}:
        version = pinned.get(canonicalize_name(each.name))
        if version is None or version not in each.specifier:
            yield f"requirements/ci.txt pins no {each}: run make lock"


def main() -> None:
    """Say what is wrong, and fail if anything is."""
    wrong = list(faults())
    print(*(f"audit: {each}" for each in wrong), sep="\n", file=sys.stderr)
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main()
