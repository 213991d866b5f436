"""What methods ask for beside points: a look at their signatures, before any work is done."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from inspect import Parameter, signature
from typing import Any

from crustline.errors import InputError, shown

_NAMED = (Parameter.POSITIONAL_OR_KEYWORD, Parameter.KEYWORD_ONLY)


def parameters_of(method: Callable[..., Any]) -> dict[str, Parameter]:
    """Return the parameters of a method after its points, by their names."""
    try:
        known = signature(method).parameters
    except (TypeError, ValueError):  # of some functions in C nobody knows
        return {"parameters": Parameter("parameters", Parameter.VAR_KEYWORD)}
    if not known:
        raise InputError(f"the method {name_of(method)} takes no points: give one that does")
    return dict(list(known.items())[1:])


def as_method(method: object, given: Mapping[str, Any]) -> Callable[..., Any]:
    """Return a method that takes the parameters given, or an `InputError` for anything else."""
    if callable(method):
        check_parameters(method, given, name_of(method), "pass {}=…")
        return method
    spelled = method.replace("-", "_") if isinstance(method, str) else ""
    name = spelled if spelled.isidentifier() and len(spelled) < 30 else "connect"
    raise InputError(f"method is {shown(method)}, not a function: write method=cl.{name}")


def name_of(method: Callable[..., Any]) -> str:
    """Return what messages call a method."""
    return str(getattr(method, "__name__", type(method).__name__))


def check_parameters(
    method: Callable[..., Any], given: Mapping[str, Any], name: str, advice: str
) -> None:
    """Refuse parameters that a method does not have, and the lack of one that it needs.

    `advice` is how to give one, such as "add -p {}=VALUE".
    """
    known = parameters_of(method)
    own = [key for key, each in known.items() if each.kind in _NAMED]
    open_ended = any(each.kind is Parameter.VAR_KEYWORD for each in known.values())
    for key in given:
        if key not in own and not open_ended:
            has = f"it has {', '.join(own)}" if own else "it has none"
            raise InputError(f"the method {name} has no parameter {shown(key)}: {has}")
    missing = [key for key in own if known[key].default is Parameter.empty and key not in given]
    if missing:
        raise InputError(f"the method {name} needs {missing[0]}: {advice.format(missing[0])}")
