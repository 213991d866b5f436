"""Large text, read in pieces: the same points and words as at once, in bounded memory."""

from __future__ import annotations

import tracemalloc
import warnings
from pathlib import Path

import numpy as np
import pytest

from crustline import CrustlineError, FormatError, Points, read
from crustline.errors import FormatWarning
from crustline.formats import stream, text
from crustline.formats.text import pieces
from test_formats_dialects import UNDERSTOOD

ROWS = "".join(f"{k / 3!r},{k * k % 7},{k}\n" for k in range(20))
ODD = {
    "decimal commas farther below": "x;y\n1;2\n3;4\n5;6\n7;8\n1,5;2,5\n",
    "text farther below": "x,y,n\n1,2,3\n3,4,5\n5,6,7\n7,8,no\n",
    "floats farther below": "x,y,n\n1,2,3\n3,4,5\n5,6,7\n7,8,2.5\n",
    "an end of line in quotes": 'x,y,n\n1,2,"a\nb\nc\nd\ne"\n3,4,"f"\n5,6,"g"\n7,8,"h"\n',
    "a count": "title\n6\n" + "".join(f"{k}.5 {k * k}\n" for k in range(6)),
    "a count that may be a point": "6 0\n" + "".join(f"{k}.5 {k * k}\n" for k in range(6)),
    "a sentinel": "x,y\n" + "".join(f"{k},{k * k}\n" for k in range(9)) + "-9999,-9999\n",
    "breaks": "x y\n" + "1 2\n3 4\nNaN NaN\n" * 4,
    "a bad row": "x,y\n" + "1,2\n3,4\n" * 4 + "5\n",
    "a bad number": "x,y\n" + "1,2\n3,4\n" * 4 + "5,abc\n",
    "old Macs": "x,y\r1,2\r3,4\r5,6\r7,8\r",
    "Windows": "x,y\r\n1,2\r\n3,4\r\n5,6\r\n7,8\r\n",
    "comments to the end": "x,y\n1,2\n3,4\n" + "# c\n" * 9,
    "not UTF-8": "x,y\n" + "1,2\n" * 9 + "3,4 # \udcff\n",
    "a null": "x,y\n" + "1,2\n" * 9 + "3,\0\n",
    "geometries": "wkt;n\nPOINT (1 2);1\nPOINT (3 4);2\nPOINT (5 6);3\nPOINT (7 8);4\n",
    "nothing": "\n \n",
    "numbers": "x,y,n\n" + ROWS,
    "empty columns behind": "x,y,\n" + "1,2,\n" * 9,
}


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Take each file for a large one, and three lines for a piece."""
    monkeypatch.setattr(text, "LARGE", 0)
    monkeypatch.setattr(pieces, "_ROWS", 3)


def told(path: Path) -> tuple[object, list[str]]:
    """Return the points of a file or what is said instead, and the warnings."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            answer: object = read(path)
        except CrustlineError as error:
            answer = str(error)
    return answer, [str(each.message) for each in caught if each.category is FormatWarning]


@pytest.mark.parametrize("content", [*UNDERSTOOD.values(), *ODD.values()], ids=[*UNDERSTOOD, *ODD])
def test_in_pieces_is_as_at_once(
    tmp_path: Path, content: str | bytes, request: pytest.FixtureRequest
) -> None:
    path = tmp_path / "a.csv"
    path.write_bytes(
        content if isinstance(content, bytes) else content.encode("utf-8", "surrogateescape")
    )
    expected = told(path)
    request.getfixturevalue("small")
    assert told(path) == expected


def test_pieces_follow_one_another(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("x,y,n\n" + ROWS)
    found = list(stream(path, 6))
    assert [len(each) for each in found] == [5, 6, 6, 3]
    assert np.concatenate([each.xy for each in found]).tolist() == read(path).xy.tolist()
    assert np.concatenate([each.columns["n"] for each in found]).tolist() == list(range(20))
    assert {each.names for each in found} == {("x", "y")}


def test_faults_in_later_pieces_name_their_line(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("x,y\n" + "1,2\n" * 50 + "3,abc\n")
    with pytest.raises(FormatError, match=r"line 52, column 'y': 'abc'"):
        list(stream(path, 7))
    path.write_text("50 3\n" + "1.5 2.5\n" * 50)
    with pytest.raises(FormatError, match="--skip-lines 1"):
        list(stream(path, 7))


def test_memory_is_that_of_a_piece(tmp_path: Path) -> None:
    """The whole text, its lines and their cells were held at once: over ten times the points."""
    path = tmp_path / "a.csv"
    path.write_text("x,y\n" + "0.1234567890123456,0.6543210987654321\n" * 60_000)

    def peak(reading: object) -> int:
        tracemalloc.start()
        assert sum(map(len, reading())) == 60_000  # type: ignore[operator]
        most = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return most

    at_once = peak(lambda: [read(path)])
    assert peak(lambda: stream(path, 2000)) < at_once / 3


def test_fields_of_fixed_width() -> None:
    """Numbers that fill their columns run into each other."""
    lines = "  1.25-10.50A7\n100.25 10.50B \n\n# none\n200.25  0.50   \n"
    points = read(lines.encode(), format="xyz", fields="1-6,7-12,13-13")
    assert points.xy.tolist() == [[1.25, -10.5], [100.25, 10.5], [200.25, 0.5]]
    assert points.columns["column2"].tolist() == ["A", "B", ""]
    named = b'x     y     name\n1.5   2.5   a "b"\n'
    points = read(named, fields=[(1, 6), (7, 12), (13, 18)])
    assert points.xy.tolist() == [[1.5, 2.5]]
    assert points.columns["name"].tolist() == ['a "b"']


@pytest.mark.parametrize("fields", ["1-8", "8-1,9-10", "a-b,c-d", "1,2", "0-3,4-5", 7])
def test_fields_that_are_none_are_refused(fields: object) -> None:
    with pytest.raises(CrustlineError, match="first and last character"):
        read(b"1 2\n", fields=fields)


def test_a_large_file_is_read_in_pieces(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(text, "LARGE", 100)
    monkeypatch.setattr(text, "split_lines", None)  # which only reading at once calls
    path = tmp_path / "a.csv"
    path.write_text("x,y,n\n" + ROWS)
    points = read(path)
    assert isinstance(points, Points)
    assert points.columns["n"].dtype == np.int64
