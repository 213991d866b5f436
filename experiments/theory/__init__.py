"""Where the theory's thresholds lie in practice: docs/experiments.md."""
