"""Build the contenders that are programs, and say which contenders this machine lacks."""

import subprocess
from pathlib import Path

from .data import BUILD
from .rivals import CGAL, CONTENDERS, RUST, Contender

RIVALS = Path(__file__).parent / "rivals"
# CGAL itself asks g++ for -frounding-math. No -march: the wheels of crustline have none either.
CGAL_FLAGS = ("-std=c++17", "-O3", "-DNDEBUG", "-frounding-math")
CGAL_COMMAND = (
    "g++",
    *CGAL_FLAGS,
    str(RIVALS / "cgal" / "cgal.cpp"),
    "-o",
    CGAL,
    "-lgmp",
    "-lmpfr",
)
RUST_MANIFEST = str(RIVALS / "rust" / "Cargo.toml")
RUST_COMMAND = (
    *("cargo", "build", "--release", "--quiet", "--locked"),
    *("--manifest-path", RUST_MANIFEST, "--target-dir", str(BUILD / "rust")),
)


def is_stale(program: str, sources: Path) -> bool:
    built = Path(program)
    newest = max(path.stat().st_mtime for path in sources.rglob("*") if path.is_file())
    return not built.exists() or built.stat().st_mtime < newest


def build_programs() -> None:
    """Build what is stale; a failure is shown by the compiler, and `absence` tells the table."""
    BUILD.mkdir(exist_ok=True)
    for program, sources, command in ((CGAL, "cgal", CGAL_COMMAND), (RUST, "rust", RUST_COMMAND)):
        if is_stale(program, RIVALS / sources):
            Path(program).unlink(missing_ok=True)
            subprocess.run(command, check=False)


def absence(contender: Contender) -> str | None:
    """Return why a contender cannot run on this machine, or None if it can."""
    program, *arguments = contender.command
    if not Path(program).exists():
        return "not built (see the compiler's message above)"
    if arguments[:1] != ["-m"]:
        return None
    module = f"benchmarks.rivals.{arguments[2]}"
    trial = subprocess.run([program, "-c", f"import {module}"], capture_output=True, text=True)
    return trial.stderr.strip().rpartition("\n")[2] or None if trial.returncode else None


def available() -> tuple[list[Contender], dict[str, str]]:
    """Build, and return the contenders that can run, and for each other label the reason."""
    build_programs()
    reasons = {contender.label: absence(contender) for contender in CONTENDERS}
    ready = [contender for contender in CONTENDERS if reasons[contender.label] is None]
    return ready, {label: reason for label, reason in reasons.items() if reason}
