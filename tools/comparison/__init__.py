"""Published formulas of other simulators on echoloop's geometry, beside figures of recordings: docs/comparison.md."""
