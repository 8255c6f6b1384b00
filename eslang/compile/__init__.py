"""Forms become Python functions.

In reading order: the registry of names and their signatures, lambda lists,
scope, macro expansion, the special forms of the host language, the core
language they come down to, its Python code, and the checks on the way.

This room must not know what a task, a failure's recovery or a fact is.
"""
