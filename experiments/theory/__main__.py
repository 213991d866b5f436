"""Measure where the theory's thresholds lie in practice: python -m experiments.theory [--quick]

Writes docs/experiments.md and docs/experiments_*.png: how often each method finds a curve exactly,
how good the local feature size and the splines are, and what certificates are worth. Seeded: the
same numbers every time. With --quick an eighth of it goes to the terminal, and no file is written.
"""

from __future__ import annotations

import sys
from multiprocessing import Pool
from pathlib import Path

import numpy as np
import numpy.typing as npt
from matplotlib import rc_context, rcdefaults

from experiments.theory.cases import cases_table
from experiments.theory.certificates import certificate_findings, certificate_table
from experiments.theory.curves import families, measured_curves
from experiments.theory.pictures import draw_orders, draw_shares
from experiments.theory.shares import earlier_table, error_table, share_table, threshold_table
from experiments.theory.sizes import feature_size_errors, feature_size_table
from experiments.theory.splines import smooth_errors, smooth_table
from experiments.theory.trials import PROCESSES, RATIOS, STARTS, Trials, trials

Rows = npt.NDArray[np.float64]

ROOT = Path(__file__).resolve().parent.parent.parent
PAGE = """# Experiments

Made by `make experiment` from [`experiments/theory`](../experiments/theory); the same numbers every
time. {curves} smooth curves, each sampled from {starts} starts at each r: {families}. Two modes:

- *sparsest*: each step along the curve is as long as an r-sample allows;
- *random*: each step is between half and the whole of that.

Every sample is an r-sample by proof over the whole curve (`cl.r_sample`), and *exact* means that
the edges are those between samples adjacent along the curve, none missing and none too many. Small
figures are 95 % intervals (Wilson), wider than for independent trials because the starts on one
curve are not; they are about curves like these, which we chose, and not about yours.

## How sparse samples may be

![Share of exact reconstructions against r](experiments_exact.png)

{thresholds}

"Proven" is where the theorems of the paper hold ([theory](theory.md)); "all right up to" is the
last r of the tables below before the first failure.

The theorems are about the worst curve, and cautious: on these curves the crust errs nowhere below
2.5 times the r that is proven for it, the β-skeleton for β = 1.70 nowhere below twice its own.
The order is reversed, though. What can be proven is better for β = 1.70 than for the crust; what
happens is worse. On a circle, the radius βd/2 of the forbidden region exceeds the circle's own
once the sparsest samples have r > 2 sin(φ/2), φ = arcsin(1/β); then all edges are lost. That is r
= 0.62 for β = 1.70, 0.85 for β = 1.3 and 0.89 for β = 1.25, and there the columns below drop. So
β = 1.25 to 1.3, for which less can be proven, lasts longer. The one-step crust, which is cheaper
and contains the crust, is all but equal to it. Gabriel and relative neighborhood graph and RCGH
keep edges across the inside of curves at any r.

For any method at all two limits are known, by Bjerkevik [1]: from a 0.66-sample a curve can
always be reconstructed, by an algorithm similar to NN-crust; from a 0.72-sample not always, since
two curves may share it. That replaces the r = 1 of the paper's Observation 6. It is no
contradiction that most reconstructions are exact beyond 0.72: it takes one curve in all to make a
limit, and ours are not made to be hard. Nor does 0.66 promise anything for the methods here,
though in this experiment the crust, NN-crust and β = 1.3 made no error up to 0.65.

[1] H. B. Bjerkevik, "Tighter Bounds for Reconstruction from ε-Samples", 38th International
Symposium on Computational Geometry (SoCG), 2022;
[arXiv:2112.03656](https://arxiv.org/abs/2112.03656).

### Sparsest samples: exact reconstructions, %

{sparsest}

### Random samples: exact reconstructions, %

{random}

### How wrong: edges missing (−) and too many (+) for each sparsest sample

{errors}

### Against earlier figures

A study of ours with other curves had given these shares for sparsest samples.

{earlier}

That the crust is always right up to 0.65 and nearly always at 0.7 and 0.8, and where the
β-skeleton for β = 1.70 begins to fail, is confirmed. The rest depends on the curves more than on
the method: ours, with narrow gaps between components and bent strips, are harder, and give lower
shares.

## The local feature size from samples

`cl.local_feature_size(points, edges)` on the true edges, against the curve's own, at the samples of
four starts: relative errors, the median and the worst. The order is the slope over the last
halving.

![Errors against r](experiments_orders.png)

{sizes}

At r = 0.2 the median is within 10 % on each curve. The worst sample is off by up to a fifth on
blobs. Medians converge at about the second order or faster on smooth curves. The stadium is the
exception: its curvature jumps at four joints, which samples cannot show, and the error near them,
of up to 13 %, stays at any r. On the circle the estimate is exact but for rounding.

## Splines instead of polygons

`cl.smooth` through sparsest samples: how many times nearer to the curve it stays than the polygon,
at the place where each is farthest from it; the worst of four starts. Orders over the last halving.

{smooth}

The spline is of the fourth order or better where the curve is smooth enough, of the second where
the curvature jumps (stadium), in between for the superformula, whose exponents are not even
integers.
"Ten times better at r = 0.25" holds for the circle, the ellipses, the stadium, the trefoil and the
superformula, and for some of the blobs. The others need r = 0.125: LFS bounds the curvature, not
how fast it changes, and a dent may fit between three samples.

No method can have ten times for all curves. Through a 0.22-sample of blob 4 (seed 5) runs another
curve, `shapes.spline`, of which it is a 0.24-sample. The two are farther apart than a fifth of the
polygon's distance from either, so that whatever runs through these samples is not ten times nearer
to both. The stadium's joints are found from three or four samples on each side; with fewer, as on
`stadium(1, 1)` at r = 0.25, the factor stays at 4.

## What a certificate is worth

`cl.certify` for the crust and the β-skeleton of every sample above: the share of the *correct* edge
sets that it guarantees, in percent, and how many *wrong* ones it guarantees, which must be none.

{certificates}

{findings}

Past the threshold of the theorem nothing is certified, however right it is. No wrong set of edges
was certified. In fact none of them came near: each had an end, a branch or an isolated point,
which is decided exactly, so the estimate of the sampling ratio was not put to the test by these
curves.

## Points whose curves are known

76 point sets with true edges: drawn, scanned, derived from outlines, vector drawings (also jittered
and with outliers), synthetic ones with corners and open ends. They are other people's and not
part of this repository. Most are outside of the theory: corners, ends, noise. The figure is Dice's
coefficient of found and true edges, in percent, averaged over the group; small, how many point sets
are exactly right.

{cases}

On points that no theorem covers the crust is the best or nearly the best in most groups; β = 1.70
is too strict for corners and sparse outlines. With outliers no method gets a whole point set
right: to remove them is another problem.
"""


def page(t: Trials, sizes: dict[str, list[Rows]], errors: dict[str, Rows]) -> str:
    """Return docs/experiments.md."""
    fields = {
        "curves": t.exact.shape[0],
        "starts": t.exact.shape[3],
        "families": ", ".join(f"{len(f)} {name}" for name, f in families().items()),
        "sets": t.exact[..., 0].size,
        "thresholds": threshold_table(t),
        "sparsest": share_table(t, 0),
        "random": share_table(t, 1),
        "errors": error_table(t),
        "earlier": earlier_table(t),
        "sizes": feature_size_table(sizes),
        "smooth": smooth_table(errors),
        "certificates": certificate_table(t),
        "findings": certificate_findings(t),
        "cases": cases_table(),
    }
    return PAGE.format(**fields)


def main(quick: bool) -> None:
    """Run the experiment; write the page and its pictures, or print the page."""
    t = trials(8 if quick else 1, RATIOS[::3] if quick else RATIOS, 1 if quick else STARTS)
    names = list(measured_curves())[:: 5 if quick else 1]
    with Pool(PROCESSES) as pool:
        sizes = dict(zip(names, pool.map(feature_size_errors, names, chunksize=1), strict=True))
        errors = dict(zip(names, pool.map(smooth_errors, names, chunksize=1), strict=True))
    text = page(t, sizes, errors)
    if quick:
        print(text)
        return
    (ROOT / "docs" / "experiments.md").write_text(text, encoding="utf-8")
    # Matplotlib's own settings, not the user's.
    with rc_context():
        rcdefaults()
        for name, figure in (
            ("exact", draw_shares(t)),
            ("orders", draw_orders(sizes, errors)),
        ):
            path = ROOT / "docs" / f"experiments_{name}.png"
            figure.savefig(path, dpi=110, metadata={"Software": None})
    print("docs/experiments.md: written")


if __name__ == "__main__":
    main("--quick" in sys.argv[1:])
