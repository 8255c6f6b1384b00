"""A naive evaluator of programs, which compiled code is compared with."""
