"""Which methods can be decided tile by tile, and how the core calls them."""

from __future__ import annotations

from typing import Any

import numpy as np

from crustline import _core
from crustline.arrays import IntArray
from crustline.delaunay import Delaunay
from crustline.methods import METHODS, Method, check_parameters

Rule = tuple[str, list[float]]
"""The name of a method in the core, and its parameters there."""


class _Listener(Delaunay):
    """A triangulation of nothing that notes what a method asks the core for."""

    def __init__(self) -> None:
        super().__init__(np.empty((0, 2)))
        self.heard: list[Rule] = []

    def select(self, method: str, *parameters: float) -> IntArray:
        """Note the method and its parameters, and give the edges of nothing."""
        self.heard.append((method, [float(each) for each in parameters]))
        return super().select(method, *parameters)


def rule_of(method: Method, parameters: dict[str, Any]) -> Rule:
    """Return what the core is to decide by, or raise `InputError` if tiles cannot.

    A method is local if what decides an edge is near to it. That is known of the crust, the
    one-step crust, the β-skeleton of circles with β > 1, and the graphs of fixed crossing angle.
    """
    names = {function: name for name, function in METHODS.items()}
    name = names.get(method, getattr(method, "__name__", repr(method)))
    check_parameters(method, parameters, name, "pass {}=")
    listener = _Listener()
    method(listener, **parameters)
    rule = listener.heard[0] if listener.heard and method in names else (name, [])
    _core.candidates(_core.Delaunay(np.empty((0, 2))), rule)
    return rule
