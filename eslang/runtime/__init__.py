"""Tasks and control: what happens while a plan runs.

In reading order: hooks (what the kernel tells whoever listens), the clock, the
one random source, failures with the recovery procedures that answer them, and
the translation of the host's errors into failures.

This room must not know any syntax, and it prints nothing: listeners do.
"""
