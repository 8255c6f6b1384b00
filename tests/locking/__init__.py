"""Property locks without a language: a world of switches, and tasks that are Python functions."""
