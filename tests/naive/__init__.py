"""A naive evaluator of programs, for comparison with compiled code."""
