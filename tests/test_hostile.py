"""Whatever a public function is given, it answers, or says in one sentence what does not fit."""

from __future__ import annotations

import faulthandler
from collections.abc import Callable, Iterator
from fractions import Fraction
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings

import crustline as cl
import hostile
from crustline import shapes
from hostile import Call

#: A call that takes longer is shown where it is, and the run ends.
HANGS = 600
TRIANGLE = [(0, 0), (1, 0), (0, 1)]


@pytest.fixture(autouse=True)
def in_a_folder_of_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """What is written by a name of any kind goes there."""
    monkeypatch.chdir(tmp_path)
    yield
    faulthandler.cancel_dump_traceback_later()


@given(call=hostile.calls())
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
def test_any_call_is_answered_or_refused_in_a_sentence(call: Call) -> None:
    faulthandler.dump_traceback_later(HANGS, exit=True)
    hostile.refusal(call)


def test_every_function_answers_what_fits() -> None:
    """Else the calls above prove nothing."""
    answered = set()
    for name, function in hostile.FUNCTIONS.items():
        for turn in range(40):
            rng = np.random.default_rng(turn)
            pools = {
                each.name: hostile.fitting(name, each.name)
                for each in hostile.parameters(function).values()
                if each.default is each.empty
            }
            given = {key: pool[rng.integers(len(pool))] for key, pool in pools.items()}
            if hostile.refusal(Call(name, function, given)) is None:
                answered.add(name)
                break
    needs_one_of_two = {"Spline.sample"}
    needs_pyvista = set() if find_spec("pyvista") else {"Curves.to_pyvista"}
    # The second needs the front end, which is built apart.
    optional = needs_pyvista | {"Curves.edit"}
    assert answered - optional == set(hostile.FUNCTIONS) - needs_one_of_two - optional


itself: list[Any] = []
itself.extend([itself, itself])

# What once ended otherwise.
REFUSED: dict[str, tuple[Callable[[], Any], str]] = {
    "a number in an array": (lambda: cl.crust(np.array(5.0)), r"points: array\(5\.\) is not"),
    "a list of itself": (lambda: cl.crust(itself), "points: row 0"),
    "a method by its name": (
        lambda: cl.reconstruct([], method="crust"),  # type: ignore[arg-type]
        "method is 'crust', not a function: write method=cl.crust",
    ),
    "a code as CRS": (
        lambda: cl.Points([], crs=4326),  # type: ignore[arg-type]
        "crs is 4326, not text: write it as crs='EPSG:4326'",
    ),
    "a code as CRS of a file": (
        lambda: cl.read(b"x,y\n1,2\n", crs=4326),  # type: ignore[arg-type]
        "crs is 4326, not text: write it as crs='EPSG:4326'",
    ),
    "one name for two coordinates": (
        lambda: cl.Points([], names=["a"]),
        r"names is \['a'\]: pass two different names",
    ),
    "heights that are complex": (lambda: cl.Points([(0, 0)], z=[1j]), "z must be a number"),
    "a progress that is none": (
        lambda: cl.r_sample(shapes.circle(), 0.5, progress=lambda: None),  # type: ignore[misc, arg-type]
        "give a function of a stage and a fraction",
    ),
    "a number for progress": (
        lambda: cl.Delaunay([(0, 0)], progress=5),  # type: ignore[arg-type]
        "progress is 5: give a function",
    ),
    "a line without end": (lambda: cl.section(hostile.Endless()), "is no line"),
    "a start without end": (
        lambda: cl.trace(TRIANGLE, [(0, 1)]).oriented(start=hostile.Endless()),
        "give x and y, a row",
    ),
    "a start in the complex plane": (
        lambda: cl.trace(TRIANGLE, [(0, 1)]).oriented(start=np.zeros(2, complex)),  # type: ignore[arg-type]
        "give x and y, a row",
    ),
    "a start whose row has a hundred digits": (
        lambda: cl.trace(TRIANGLE, [(0, 1)]).oriented(start=10**100),
        "start is row 1000",
    ),
    "an accuracy beyond the width": (
        lambda: cl.center_line(cl.trace(TRIANGLE, [(0, 1), (1, 2), (0, 2)]), accuracy=1e308),
        r"accuracy must be in \[1e-6, 1\]",
    ),
    "an accuracy beyond floats": (
        lambda: cl.center_line(cl.trace(TRIANGLE, [(0, 1), (1, 2), (0, 2)]), accuracy=5e-324),
        r"accuracy must be in \[1e-6, 1\]",
    ),
    "an axis of more samples than memory holds": (
        lambda: cl.center_line(
            cl.trace(
                [(0, 0), (1e5, 0), (1e5, 1), (0, 1)], [(0, 1), (1, 2), (2, 3), (0, 3)]
            ),
            accuracy=1e-6,
        ),
        "asks for more than 10,000,000 samples",
    ),
    "a band thinner than any number": (
        lambda: cl.slices(np.eye(4, 3), "z=0", thickness=5e-324), "the scale 4.94066e-324 is too"
    ),
    "a CRS that is no text": (
        lambda: cl.project(cl.Points([(0, 1)], crs="EPSG:4326"), crs="1\n2\0\ud800"),
        r"the CRS '1\\n2\\x00\\ud800' is unknown",
    ),
    "planes without end": (
        lambda: cl.slices([(0, 0, 0)], hostile.Endless()),
        "more than 100,000 planes",
    ),
    "an array for a format of slices": (
        lambda: cl.slices(b"", "z=0", format=np.eye(3)),  # type: ignore[arg-type]
        "format",
    ),
    "a curve that is none": (lambda: cl.r_sample(3, 0.5), "curve is 3, not a SmoothCurve"),  # type: ignore[arg-type]
    "a choice that is an array": (
        lambda: cl.r_sample(shapes.circle(), 0.5, mode=np.zeros(2)),  # type: ignore[arg-type]
        "mode must be 'sparsest' or 'random', not array",
    ),
    "a parameter in lines": (
        lambda: cl.beta_skeleton([], np.eye(3)),  # type: ignore[arg-type]
        r"beta must be positive and finite, not array\(\[\[1\., 0\., 0\.\], \[",
    ),
    "a place that is text": (lambda: shapes.circle().point("a"), "t must be a number"),
    "a place beyond floats": (lambda: shapes.circle().point(10**400), "t must be a number"),
    "more points than there is room for": (
        lambda: shapes.lattice(2**40), "n must be a whole number from 0 to 100000000"
    ),
    "a tolerance too small": (
        lambda: cl.smooth(cl.reconstruct(hostile.RING))[0].sample(tolerance=1e-300),
        "tolerance asks for more than 100,000,000 points",
    ),
    "rows that are none": (lambda: cl.Points([(0, 0)]).select([1]), "rows: 1 is none of the 1"),
    "a method by its name, to denoise": (
        lambda: cl.denoise(hostile.RING, method="crust"),  # type: ignore[arg-type]
        "method is 'crust', not a function: write method=cl.crust",
    ),
    "a method that needs more, to denoise": (
        lambda: cl.denoise(hostile.RING, method=cl.alpha_shape), "alpha_shape needs radius"
    ),
    "noisy points beyond the squares of floats": (
        lambda: cl.denoise(hostile.RING * 1e300), "the extent of the points must be between"
    ),
    "a method of a long name": (
        lambda: cl.reconstruct([], method="x" * 9999),  # type: ignore[arg-type]
        r"x…, not a function: write method=cl\.connect",
    ),
    "a target of no format": (lambda: cl.Points([]).write("a.none"), "^.{1,399}$"),
    "noise that is no number": (lambda: cl.denoise(hostile.RING, noise=["a"]), "noise must be a n"),
    "a flag that is an array": (
        lambda: cl.reconstruct(hostile.RING, fit=np.zeros((2, 2))),  # type: ignore[arg-type]
        "fit must be True or False",
    ),
    "noise that is no row of numbers": (
        lambda: cl.reconstruct(hostile.RING, fit=True, noise=[(0, 0), (1,)]), "noise must be a num"
    ),
    "groups without end": (
        lambda: cl.by_group([(0, 0), (1, 1)], hostile.Endless()),  # type: ignore[arg-type]
        "groups: the labels are no flat list",
    ),
    "a section of a number beyond all floats": (
        lambda: cl.section(Fraction(10**400)), "is no line: write x0,y0,x1,y1"
    ),
    "a section whose name is no text": (
        lambda: cl.section((0, 0, 3, 4), name=np.zeros((2, 2))),  # type: ignore[arg-type]
        "is not text: give text",
    ),
    "a method by its name, to slices": (
        lambda: cl.slices(hostile.TETRAHEDRON, "z=0.5", method="crust"),  # type: ignore[arg-type]
        "method is 'crust', not a function: write method=cl.crust",
    ),
    "points, to center_line": (
        lambda: cl.center_line(hostile.RING),  # type: ignore[arg-type]
        "pass what trace or reconstruct returns",
    ),
    "a path that is a number": (lambda: cl.read(5), "path is 5: give a path"),
    "a target that is a number": (lambda: cl.Points([]).write(5), "path is 5: give a file name"),  # type: ignore[arg-type]
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_refused(name: str) -> None:
    call, words = REFUSED[name]
    with pytest.raises(cl.CrustlineError, match=words) as caught:
        call()
    assert "\n" not in str(caught.value)


def test_unaligned_points_are_copied() -> None:
    points = hostile.unaligned(hostile.RING)
    assert not points.flags.aligned
    assert np.array_equal(cl.crust(points), cl.crust(hostile.RING))


def test_far_samples_have_their_true_distance() -> None:
    ratio = cl.sampling_ratio(shapes.circle(), [(1e300, 0)])
    assert ratio == pytest.approx(1e300, rel=1e-3)
