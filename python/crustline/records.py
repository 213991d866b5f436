"""Records: results that are bundles of arrays, and behave as values: none changes, equal ones are
equal, and they can be pickled."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

import numpy as np

from crustline.arrays import equal, read_only


class Record:
    """What frozen dataclasses of arrays share; they are declared with ``eq=False``.

    Their arrays are read-only. Two records are equal if all fields are, arrays by shape and
    elements, NaN to NaN. Copies are the record itself, for nothing could tell them apart.
    """

    def __post_init__(self) -> None:
        # What can be written is someone else's, too.
        for name, value in _values(self).items():
            if isinstance(value, np.ndarray) and value.flags.writeable:
                object.__setattr__(self, name, read_only(value.copy()))

    def __eq__(self, other: object) -> bool:
        """Whether all fields are equal."""
        if type(self) is not type(other):
            return NotImplemented
        return all(equal(value, getattr(other, name)) for name, value in _values(self).items())

    __hash__ = None  # type: ignore[assignment]

    def __copy__(self) -> Any:
        return self

    def __deepcopy__(self, memo: object) -> Any:
        return self

    def __getstate__(self) -> dict[str, Any]:
        return _values(self)

    def __setstate__(self, state: dict[str, Any]) -> None:
        for value in state.values():
            if isinstance(value, np.ndarray):
                read_only(value)
        vars(self).update(state)


def _values(record: Any) -> dict[str, Any]:
    """Return the fields, and not what was computed of them and kept beside them."""
    return {each.name: getattr(record, each.name) for each in fields(record)}
