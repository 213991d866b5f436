"""Data larger than memory, or than a machine: the same edges and curves as in one piece.

What makes an edge of the crust lies near to it, at the scale of the spacing, so tiles decide edges,
and say of the others what they need to see. `docs/scale.md` tells why that is exact. Dask schedules
the work, on this machine or on a cluster.
"""

from __future__ import annotations

from crustline.distributed.reconstruct import reconstruct
from crustline.distributed.result import Result

__all__ = ["Result", "reconstruct"]
