"""Programs: which forms there are, and how often each is chosen."""

from __future__ import annotations

from random import Random

from programs.calls import Calls
from programs.words import Scope

PLAIN = ("arithmetic", "note", "choice", "order", "assignment", "collected")
BINDING = ("let", "let", "closure", "symbol_macro", "macro", "progv")
JUMPS = ("block", "catch", "protect", "leave", "tags", "loop")
VALUES = ("receive", "listed")
FUNCTIONS = ("local_function", "recursion", "called", "parameters", "closures_in_a_loop")
FAILURES = ("recovery", "recovery", "recovery", "cleanup", "fail", "fail", "handler", "handler")


class Writer(Calls):
    """Writes one program."""

    def kinds(self) -> tuple[str, ...]:
        """All of them."""
        usual = PLAIN * 2 + BINDING * 2 + JUMPS + VALUES + FUNCTIONS
        return usual + FAILURES if self.failures else usual


def program(chance: Random, depth: int = 4, *, failures: bool = True) -> str:
    """A program, as text."""
    writer = Writer(chance, failures=failures)
    scope = Scope(variables=("x", "y", "z"))
    body = writer.body(scope, depth)
    if failures and chance.randrange(2):
        body = f"(handler-case (progn {body}) (error () (note 99)))"
    return f"(let ((x 1) (y 2) (z 3)) {body} (list x y z *a* *b*))"
