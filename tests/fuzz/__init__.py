"""Mutated files for every reader; `make fuzz-readers` runs them for as long as one likes."""
