"""A term of tests/naive/circuits.py as a program of SCS."""

from __future__ import annotations

from typing import Any

from naive.steps import Act, Await, Clause, Clauses, Condition, Group, Guarded, Steps

OPERATORS = {
    "do": ("scs:do", "scs:do*"),
    "repeat": ("repeat", "repeat*"),
    "all": ("do-all", "do*-all"),
    "any": ("do-any", "do*-any"),
    "first": ("do-first", "do*-first"),
    "best": ("do-best", "do*-best"),
}
PREAMBLE = """
(defrelation p) (defrelation q) (defrelation lit) (defrelation over) (defrelation at (place))
(defvar *x* 0) (defvar *left* 0)
(defun count-down () (when (<= (decf *left*) 0) (assert '(over))))
"""


class Writer:
    """Writes one program: the definitions of its actions and steps, and the form that runs it."""

    def __init__(self, term: Any) -> None:
        self.definitions: list[str] = []
        self.form = self.step(term)

    def step(self, term: Any) -> str:
        """TERM, as a form."""
        if isinstance(term, Act):
            return self.act(term)
        if isinstance(term, Group):
            return f"(atomic {' '.join(map(self.act, term.acts))})"
        if isinstance(term, Guarded):
            note = f'(note "out {term.name}")'
            form = f"(with-cleanup-procedure {note} {self.step(term.step)})"
            return f'(prog2 (note "in {term.name}") {form} {note})'
        if isinstance(term, Await):
            begin, end = f'(note "begin {term.name}")', f'(note "end {term.name}")'
            return f'(progn {begin} (wait-until (lit)) {end} "{term.name}")'
        return self.construct(term)

    def act(self, act: Act) -> str:
        """The call of ACT, which is defined."""
        operator = "defun" if act.is_plain else "defaction"
        place = " place" if act.about else ""
        doings = [f'(note "{act.name}"{place})', *map(effect, act.effects), "(count-down)"]
        fails = f'(if {test(act.fails)} (fail :bad "{act.name}"))'
        self.definitions.append(f'({operator} {act.name} ({place}) {" ".join(doings)} {fails} "{act.name}")')
        if act.about.startswith("?"):
            return f"({act.name} #{act.about})"
        return f"({act.name} '{act.about})" if act.about else f"({act.name})"

    def construct(self, term: Steps | Clauses) -> str:
        """A construct, with modifiers; or the call of the step that it is."""
        modifiers = "".join(f" :{word} {text(condition)}" for word, condition in term.modifiers)
        steps = "".join(f"\n {self.part(each, term.kind)}" for each in term.steps)
        if isinstance(term, Steps) and term.name:
            self.definitions.append(f"(defstep {term.name} (){modifiers}{steps})")
            return f"({term.name})"
        return f"({OPERATORS[term.kind][term.starred]}{modifiers}{steps})"

    def part(self, part: Any, kind: str) -> str:
        """A step, or a clause."""
        if not isinstance(part, Clause):
            return self.step(part)
        utility = {"x": "*x*", "-x": "(- *x*)"}.get(part.utility, str(part.utility)) if kind == "best" else ""
        return f"({text(part.condition)} {utility} {' '.join(map(self.step, part.steps))})"


def text(condition: Condition) -> str:
    """CONDITION, as it is written."""
    word, *parts = condition
    if word == "x":
        return f"(= *x* {parts[0]})"
    if word == "fact":
        return f"({' '.join(parts)})"
    return f"({word} {' '.join(map(text, parts))})" if parts else word


def test(condition: Condition) -> str:
    """A form that tells whether CONDITION holds."""
    word, *parts = condition
    if word == "fact":
        return f"(db-query '{text(condition)})"
    return f"({word} {' '.join(map(test, parts))})" if word in ("not", "and", "or") else text(condition)


def effect(what: tuple[Any, ...]) -> str:
    """A form that does it."""
    word, *parts = what
    return f"(setq *x* {parts[0]})" if word == "set" else f"({word} '({' '.join(parts)}))"
