"""Programs that mean something, end, and tell what they do: the words they are made of.

A program is one form. Its variables are integers unless they hold functions,
what it does can be seen in its values and in the trace that (note x) leaves,
and whatever could go on for ever is counted.
"""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import NamedTuple

SPECIALS = {"*A*": 10, "*B*": 20}
CAUSES = (":c1", ":c2", ":c3")


class Scope(NamedTuple):
    """What a program may mention at one place; functions come with how many arguments they take."""

    variables: tuple[str, ...] = ()
    closures: tuple[str, ...] = ()  # variables that hold functions of no argument
    functions: tuple[tuple[str, int], ...] = ()
    macros: tuple[str, ...] = ()
    blocks: tuple[str, ...] = ()
    catches: tuple[str, ...] = ()
    recovering: bool = False  # inside a recovery clause

    def bare(self) -> Scope:
        """The scope without what belongs to the forms around."""
        return Scope(self.variables, self.closures, self.functions, self.macros)


class Words:
    """Writes one program, choosing by CHANCE."""

    def __init__(self, chance: Random, *, failures: bool = True) -> None:
        self.chance = chance
        self.failures = failures
        self.count = 0

    # --- words -----------------------------------------------------------------

    def fresh(self, prefix: str) -> str:
        """A name; sometimes one that is in use already, so that it shadows."""
        if prefix == "v" and self.chance.randrange(4) == 0:
            return self.chance.choice("xyz")
        self.count += 1
        return f"{prefix}{self.count}"

    def pick(self, *choices: Callable[[], str]) -> str:
        """What one of CHOICES writes."""
        return self.chance.choice(choices)()

    def several(self, scope: Scope, depth: int, least: int = 0, most: int = 3) -> str:
        """Some forms."""
        return " ".join(self.form(scope, depth) for _ in range(self.chance.randint(least, most)))

    def body(self, scope: Scope, depth: int) -> str:
        """One to three forms, the last of which gives the value."""
        return self.several(scope, depth, 1, 3)

    # --- forms -----------------------------------------------------------------

    def form(self, scope: Scope, depth: int) -> str:
        """A form that gives an integer, if it does not fail."""
        if depth <= 0:
            return self.atom(scope)
        return str(getattr(self, self.chance.choice(self.kinds()))(scope, depth - 1))

    def kinds(self) -> tuple[str, ...]:
        """The methods that write forms; what is there twice is chosen twice as often."""
        raise NotImplementedError

    def atom(self, scope: Scope) -> str:
        """A number, a variable, a call or a jump."""
        choice = self.chance.randrange(12)
        if choice < 5 and scope.variables:
            return self.chance.choice(scope.variables)
        if choice == 5:
            return self.chance.choice(tuple(SPECIALS)).lower()
        if choice == 6 and scope.closures:
            return f"(funcall {self.chance.choice(scope.closures)})"
        if choice == 7 and scope.blocks:
            return f"(return-from {self.chance.choice(scope.blocks)} {self.several_values(scope, 0)})"
        if choice == 8 and scope.catches:
            return f"(throw {self.chance.choice(scope.catches)} {self.several_values(scope, 0)})"
        if choice == 9 and scope.variables:
            return f"(note {self.chance.choice(scope.variables)})"
        if choice == 10 and scope.macros:
            return f"({self.chance.choice(scope.macros)} {self.chance.randrange(9)})"
        if choice == 11 and scope.recovering:
            return self.chance.choice(("(retry)", "(abort 1)", "(abort (note 2))"))
        return str(self.chance.randrange(10))

    def several_values(self, scope: Scope, depth: int) -> str:
        """A form that gives one value, or several."""
        if self.chance.randrange(2):
            return self.form(scope, depth)
        return f"(values {self.several(scope, depth, 1, 3)})"
