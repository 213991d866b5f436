"""Mutate files, read them, and keep those that end in anything but an answer or one sentence.

    python tests/fuzz/readers.py --count 50000 --seed 1 csv wkt

Each reading has five seconds and a gigabyte. What fails is kept in `corpus`, which the suite reads
again in each run.
"""

from __future__ import annotations

import argparse
import gzip
import hashlib
import io
import random
import signal
import sys
import time
import warnings
import zipfile
from pathlib import Path
from types import FrameType

import numpy as np

from crustline import CrustlineError, read
from crustline.formats import read_curves

CORPUS = Path(__file__).parent / "corpus"
SECONDS, BYTES, LONGEST = 5.0, 1 << 30, 500
WORDS = [
    b"", b"0", b"-", b".", b",", b";", b"\t", b" ", b"\n", b"\r", b'"', b"'", b"#", b"(", b")",
    b"[", b"]", b"{", b"}", b":", b"e", b"E9999", b"nan", b"inf", b"-9999", b"x", b"\xff", b"\x00",
    b"1e308", b"null", b"POINT", b"EMPTY", b"SRID=", b'"type"', b"\xc2\xb0", b"N", b"9" * 400,
    b"(" * 300,
]  # fmt: skip


def _npy(array: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> bytes:
    stream = io.BytesIO()
    np.save(stream, array)
    return stream.getvalue()


def _npz() -> bytes:
    stream = io.BytesIO()
    arrays = {"indices": np.arange(3), "offsets": np.array([0, 3]), "closed": np.array([True])}
    np.savez(stream, points=np.eye(3, 2), isolated=np.arange(0), crs=np.array("a"), **arrays)
    return stream.getvalue()


def _zip(name: str, content: bytes) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(name, content)
    return stream.getvalue()


TABLE = b'x,y,z,name\n1.5,2.5,3,"a ""b"""\n3.5,4.5,4,c\n5.5,2.5,5,\n'
SEEDS: dict[str, list[bytes]] = {
    "csv": [
        TABLE,
        b"x;y\n1,5;2,5\n3,5;4,5\n",
        b"curve,order,row,x,y,closed\n0,0,0,1,2,1\n0,1,1,3,4,1\n0,2,2,5,0,1\n-1,0,3,9,9,0\n",
        "lon;lat\n8°30'36\"E;47°15'N\n".encode(),
        b"id,wkt\n1,POINT (1 2)\n2,\"LINESTRING (3 4, 5 6)\"\n",
        b"sep=;\nx;y\n1.234.567,5;2\n",
    ],
    "xyz": [
        b"E387\n 1. 2.\n\n1.5 2.5\n3.5 4.5\n5.5 2.5\n",
        b"* c\nL001\n3 2\n1 2\n3 4\n5 6\n",
        b'TITLE="t"\nVARIABLES = "X", "Y"\nZONE I=2\n1 2\n3 4\n',
        b"# x y\n1 2 #ff0000\n> -Z1\nNaN NaN\n0.6D+03 4\n",
    ],
    "geojson": [
        b'{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"a":[1,2]},'
        b'"geometry":{"type":"LineString","coordinates":[[0,0],[1,2.5]]}},{"type":"Feature",'
        b'"properties":null,"geometry":{"type":"MultiPolygon","coordinates":[[[[0,0],[4,0],[4,4],'
        b"[0,0]]]]}}]}",
    ],
    "json": [
        b"[[0,0],[1,0.5]]",
        b'[{"x":1,"y":2},{"x":3,"y":4}]',
        b'{"x":1,"y":2}\n{"x":3,"y":4}\n',
    ],
    "wkt": [
        b"SRID=25832;POLYGON Z ((0 0 1, 4 0 1, 4 4 1, 0 0 1), (1 1 1, 2 1 1, 1 2 1, 1 1 1))\n"
        b"GEOMETRYCOLLECTION (POINT Z (1 2 3), MULTIPOINT Z ((1 2 3), (3 4 5)))\n",
    ],
    "npy": [_npy(np.eye(4, 2)), _npy(np.eye(4, 3))],
    "npz": [_npz()],
    "packed": [gzip.compress(TABLE), _zip("a.csv", TABLE), _zip("a.wkt", b"POINT (1 2)")],
}  # fmt: skip


def mutated(seed: bytes, rng: random.Random) -> bytes:
    """Return a file with some pieces replaced, repeated, moved or cut off."""
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


def fault_of(key: str, content: bytes) -> str | None:
    """Return what is wrong with how a file is read, or None if it is an answer or a sentence."""
    named = None if key == "packed" else key
    for reading in (read, read_curves):
        try:
            reading(content, format=named)
        except CrustlineError as error:
            message = str(error)
            if "\n" in message or len(message) > LONGEST:
                return f"a message of {len(message)} characters: {message[:80]!r}"
        except Exception as error:  # whatever it is, it should not be
            return f"{type(error).__name__}: {str(error)[:80]}"
    return None


def _too_long(signal: int, frame: FrameType | None) -> None:
    raise TimeoutError("over five seconds")


def fuzz(key: str, count: int, seed: int) -> list[str]:
    """Read mutated files of a format; return what was wrong, and keep the files."""
    rng = random.Random(f"{key} {seed}")
    faults = []
    for _ in range(count):
        content = mutated(rng.choice(SEEDS[key]), rng)
        signal.setitimer(signal.ITIMER_REAL, SECONDS)
        fault = fault_of(key, content)
        signal.setitimer(signal.ITIMER_REAL, 0)
        if fault and fault not in faults:
            faults.append(fault)
            name = f"{key}-{hashlib.sha256(content).hexdigest()[:10]}"
            (CORPUS / name).write_bytes(content)
            print(f"{key}: {fault} ({name})", flush=True)
    return faults


def main() -> None:
    """Run the readers that are named, or all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("keys", nargs="*", choices=[*SEEDS, []], default=[])
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    import resource

    warnings.simplefilter("ignore")
    resource.setrlimit(resource.RLIMIT_DATA, (BYTES, BYTES))
    signal.signal(signal.SIGALRM, _too_long)
    faults = []
    for key in given.keys or SEEDS:
        started = time.perf_counter()
        found = fuzz(key, given.count, given.seed)
        seconds = time.perf_counter() - started
        print(f"{key}: {given.count:,} files, {len(found)} faults, {seconds:.0f} s", flush=True)
        faults += found
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
