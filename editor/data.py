"""What the editor takes from the library: the table of methods, thresholds, samples, examples.

`python editor/data.py FOLDER` writes it as JSON, so that the page has no second list of anything.
"""

from __future__ import annotations

import inspect
import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

import crustline as cl
from crustline import shapes, theory
from crustline.certify import MARGIN
from crustline.methods import METHODS, parameters_of

ROOT = Path(__file__).parents[1]
RATIOS = [round(0.1 + 0.05 * k, 2) for k in range(19)]
CURVES = {
    "Circle": shapes.circle(),
    "Ellipse": shapes.ellipse(2, 1),
    "Stadium": shapes.stadium(2, 0.6),
    "Trefoil": shapes.trefoil(),
    "Flower": shapes.trefoil(5, 0.35),
    "Octagons, one curve": shapes.two_octagons_joined(),
    "Octagons, two curves": shapes.two_octagons_separate(),
}
EXAMPLES = {
    "Goose": "goose.csv",
    "Two octagons (Figure 6)": "two_octagons.csv",
    "Coast of New Zealand": "new_zealand.csv",
}


def catalog() -> dict[str, Any]:
    """Return the methods with their parameters, and what a certificate asks for."""
    return {
        "version": cl.__version__,
        "methods": [method(name) for name in METHODS],
        "theory": {
            "beta": theory.BETA,
            "of_skeleton": theory.guaranteed_r("beta_skeleton"),
            "of_crust": theory.guaranteed_r("crust"),
            "margin": MARGIN,
        },
    }


def method(name: str) -> dict[str, Any]:
    """Return a method's name, the first line of its docstring, and its parameters."""
    function = METHODS[name]
    says = (inspect.getdoc(function) or "").partition("\n")[0].removeprefix("Return ")
    numbers = [each for each in parameters_of(function).values() if is_number(each)]
    parameters = [
        {"name": each.name, "default": each.default if isinstance(each.default, float) else None}
        for each in numbers
    ]
    return {"name": name, "says": says[:1].upper() + says[1:], "parameters": parameters}


def is_number(parameter: inspect.Parameter) -> bool:
    """Return whether a slider can give a parameter: a number, or one of two kinds."""
    needed = parameter.default is inspect.Parameter.empty and parameter.name != "extra"
    return needed or isinstance(parameter.default, float | str)


def samples() -> dict[str, list[list[float]]]:
    """Return samples of each curve, one for each of `RATIOS`."""
    return {
        name: [flat(cl.r_sample(curve, ratio).points) for ratio in RATIOS]
        for name, curve in CURVES.items()
    }


def flat(points: Any) -> list[float]:
    """Return coordinates one after another, to nine digits after the point."""
    return np.round(np.asarray(points), 9).ravel().tolist()


def examples() -> dict[str, list[float]]:
    """Return the points of the example files."""
    folder = ROOT / "examples"
    return {title: cl.read(folder / name).xy.ravel().tolist() for title, name in EXAMPLES.items()}


def main() -> None:
    """Write the files."""
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    parts = {
        "catalog": catalog(),
        "samples": {"ratios": RATIOS, "curves": samples()},
        "examples": examples(),
    }
    for name, part in parts.items():
        (folder / f"{name}.json").write_text(json.dumps(part, ensure_ascii=False), encoding="utf-8")


if __name__ == "__main__":
    main()
