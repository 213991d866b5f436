"""Plan a distributed run past this machine: python -m experiments.scale [TILES]

Decides TILES sampled tiles (by default 4) of about a million points each of endless fields, and
says what runs of 10⁸ to 10¹⁰ such points would read, leave open and send. Prints a table.
"""

from __future__ import annotations

import sys

import numpy as np

from experiments.scale.fields import FIELDS, IN_CELL, Field
from experiments.scale.tiles import Tile, decided

TILE_POINTS = 1_000_000
SIZES = (10**8, 10**9, 10**10)
#: Bytes of a point on its way: coordinates and row.
POINT = 24


def sampled(field: Field, count: int, seed: int) -> list[Tile]:
    """Return tiles at random corners."""
    random = np.random.default_rng(seed)
    density = len(field(random)) / IN_CELL
    side = round((TILE_POINTS / (density * IN_CELL)) ** 0.5)
    corners = (10**6 * random.random((count, 2))).tolist()
    return [decided(field, (x, y), side) for x, y in corners]


def row(name: str, tiles: list[Tile], size: int) -> str:
    """Return what a run of `size` points takes, if its tiles are like these."""
    points = sum(tile.points for tile in tiles)
    halo, left, asked = (
        sum(getattr(tile, key) for tile in tiles) / points for key in ("halo", "open", "asked")
    )
    seconds = sum(tile.seconds for tile in tiles) / points * size
    shuffled = POINT * size / 1e9
    again = POINT * size * (halo + asked) / 1e9
    return (
        f"| {name} | {size:.0e} | {size // TILE_POINTS:,} | {halo:.2%} | {left * size:,.0f} | "
        f"{shuffled:,.1f} | {again:,.2f} | {seconds / 3600:,.2f} |"
    )


def main(count: int) -> None:
    """Print the table."""
    print("| data | points | tiles | halo | open after tiles | shuffled, GB | read again, GB | "
          "tiles' processor hours |")  # fmt: skip
    print("|---|---|---|---|---|---|---|---|")
    for seed, (name, field) in enumerate(FIELDS.items()):
        tiles = sampled(field, count, seed)
        for size in SIZES:
            print(row(name, tiles, size), flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 4)
