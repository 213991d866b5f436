"""The benchmarks of crustline: a project of its own, run from the root of the repository.

`python -m benchmarks.run` measures, checks and writes docs/benchmarks.md; with `--quick` it prints
the page in a minute. What it needs is in requirements.txt; CGAL is Debian's libcgal-dev.
"""
