"""A small Prolog: assertions, and questions about them.

Unification, the store of facts, queries and rules will stand here.

This room must not know what a task is, nor who waits for a fact to change.
"""
