"""A run that keeps its facts, and is killed: what the tests of the durable store start as a process."""
