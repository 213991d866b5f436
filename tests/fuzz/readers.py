"""Mutate files, read them, and keep those that end in anything but an answer or one sentence.

    python tests/fuzz/readers.py --count 50000 --seed 1 csv wkt

Each reading has five seconds and a gigabyte. What fails is kept in `corpus`, which the suite reads
again in each run.
"""

from __future__ import annotations

import argparse
import hashlib
import io
import random
import sys
import tempfile
import time
import warnings
import zipfile
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

if __name__ == "__main__":  # run as a script, it finds its neighbors
    sys.path[:0] = [str(Path(__file__).parents[1]), str(Path(__file__).parents[2])]

from crustline import CrustlineError, read, slices
from crustline.formats import FORMATS, layers, read_curves
from crustline.shapes import bezier_path
from fuzz import clouds
from fuzz.seeds import KEYS, SHAPEFILE, seeds, shapefile
from fuzz.watch import Watch

CORPUS = Path(__file__).parent / "corpus"
LONGEST = 500
WORDS = [
    b"", b"0", b"-", b".", b",", b";", b"\t", b" ", b"\n", b"\r", b'"', b"'", b"#", b"(", b")",
    b"[", b"]", b"{", b"}", b":", b"e", b"E9999", b"nan", b"inf", b"-9999", b"x", b"\xff", b"\x00",
    b"1e308", b"null", b"POINT", b"EMPTY", b"SRID=", b'"type"', b"\xc2\xb0", b"N", b"9" * 400,
    b"(" * 300,
]  # fmt: skip


def mutated(seed: bytes, rng: random.Random) -> bytes:
    """Return a file broken somewhere; an archive mostly within, where no checksum tells."""
    if seed.startswith(b"PK\x03\x04") and rng.random() < 0.7:
        return _mutated_within(seed, rng)
    return _mutated(seed, rng)


def _mutated_within(seed: bytes, rng: random.Random) -> bytes:
    with zipfile.ZipFile(io.BytesIO(seed)) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    changed = rng.choice(list(parts))
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name, part in parts.items():
            archive.writestr(name, _mutated(part, rng) if name == changed else part)
    return stream.getvalue()


def _mutated(seed: bytes, rng: random.Random) -> bytes:
    """Return bytes with some pieces replaced, repeated, or cut off."""
    content = bytearray(seed)
    for _ in range(rng.choice([1, 1, 2, 3, 6])):
        start = rng.randrange(len(content) + 1)
        end = min(len(content), start + rng.choice([0, 1, 1, 2, 5, 20]))
        kind = rng.randrange(6)
        if kind <= 2:
            content[start:end] = rng.choice(WORDS)
        elif kind == 3 and start < len(content):
            content[start] ^= 1 << rng.randrange(8)
        elif kind == 4:
            content[start:start] = content[start:end] * rng.choice([1, 3, 50])
        else:
            del content[start : start + rng.choice([1, 4, 200])]
    return bytes(content)


def readings_of(key: str) -> list[Callable[[bytes], Any]]:
    """Return all that reads a kind of file."""
    if key == "svg":
        return [_svg]
    if key in SHAPEFILE:
        return [partial(_with_siblings, key)]
    if key in clouds.KEYS:
        return _in_space("laz" if key == "copc" else key)
    if key in ("world", "axes"):
        return [partial(_with_a_picture, key)]
    if key == "image":
        options: list[dict[str, Any]] = [{}, {"mask": True}, {"lines": True}, {"color": "#e62"}]
        return [partial(read, format=key, **each) for each in options]
    name = None if key == "packed" else key
    chosen: list[Callable[..., Any]] = [read]
    if name is None or FORMATS[name].can("read_curves"):
        chosen.append(read_curves)
    if name is not None and FORMATS[name].can("layers"):
        chosen.append(layers)
    return [partial(each, format=name) for each in chosen]


def _in_space(name: str) -> list[Callable[[bytes], Any]]:
    """Return what slices a cloud or mesh, and reads the points of a cloud."""
    how = {"format": name} | ({} if name in ("stl", "obj") else {"thickness": 0.5, "fit": False})
    chosen: list[Callable[..., Any]] = [partial(slices, planes=["z=0.3", "1,1,0=0.2"], **how)]
    if name == "ply":  # with faces a mesh, which has no thickness
        chosen.append(partial(slices, planes="z=0.3", format=name))
    if FORMATS[name].can("read"):
        chosen.append(partial(read, format=name))
    return chosen


def _svg(content: bytes) -> Any:
    with tempfile.NamedTemporaryFile(suffix=".svg") as file:
        file.write(content)
        file.flush()
        return bezier_path(file.name)


def _with_a_picture(key: str, content: bytes) -> Any:
    """Read a sound picture that is placed by a world file, or by places on axes."""
    picture = seeds()["image"][0]
    if key == "axes":
        return read(picture, axes=content.decode("latin-1"))
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "a.png").write_bytes(picture)
        Path(folder, "a.pgw").write_bytes(content)
        return read(Path(folder, "a.png"))


def _with_siblings(part: str, content: bytes) -> Any:
    """Read a Shapefile one of whose files is another."""
    with tempfile.TemporaryDirectory() as folder:
        for suffix, own in shapefile().items():
            Path(folder, f"a.{suffix}").write_bytes(content if suffix == part else own)
        return read(Path(folder, "a.shp"))


def fault_of(key: str, content: bytes) -> str | None:
    """Return what is wrong with how a file is read, or None if it is an answer or a sentence."""
    for reading in readings_of(key):
        try:
            reading(content)
        except CrustlineError as error:
            message = str(error)
            if "\n" in message or len(message) > LONGEST:
                return f"a message of {len(message)} characters: {message[:80]!r}"
        except Exception as error:  # whatever it is, it should not be
            return f"{type(error).__name__}: {str(error)[:80]}"
    return None


def file_of(key: str, number: int, seed: int) -> bytes:
    """Return a mutated file by its number."""
    rng = random.Random(f"{key} {seed} {number}")
    return mutated(rng.choice(seeds()[key]), rng)


def fuzz(key: str, count: int, seed: int) -> Watch:
    """Read mutated files of a format, and keep one of each fault.

    The seeds are made in the process of the trials: libraries start threads, and a process with
    threads cannot be forked without risk.
    """

    def trial(number: int) -> str | None:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return fault_of(key, file_of(key, number, seed))

    watch, known = Watch(trial, count), set()
    for number, fault in watch.faults():
        kind = fault[:40]
        if kind not in known:
            known.add(kind)
            content = file_of(key, number, seed)
            name = f"{key}-{hashlib.sha256(content).hexdigest()[:10]}"
            (CORPUS / name).write_bytes(content)
            print(f"{key}: {fault} ({name})", flush=True)
    return watch


def main() -> None:
    """Run the readers that are named, or all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("keys", nargs="*", choices=[*KEYS, []], default=[])
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    kept = set(CORPUS.iterdir())
    for key in given.keys or KEYS:
        started = time.perf_counter()
        watch = fuzz(key, given.count, given.seed)
        seconds = time.perf_counter() - started
        found = len(set(CORPUS.glob(f"{key}-*")) - kept)
        print(
            f"{key}: {given.count:,} files, {found} kinds of faults, {seconds:.0f} s, "
            f"slowest {watch.slowest:.2f} s",
            flush=True,
        )
    sys.exit(set(CORPUS.iterdir()) > kept)


if __name__ == "__main__":
    main()
