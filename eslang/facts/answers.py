"""What becomes of the answers that a query finds: how its own function tells them.

All of them are told as dicts or as the alists of Lisp; or the first is; or one
after another, by a generator.
"""

from __future__ import annotations

from eslang.base.hints import Callable, NamedTuple

ALL, ALISTS, FIRST, LAZY = "all", "alists", "first", "lazy"
Told = dict[str, str]  # the Python expressions for variables, and for their values
GENERATES = ("yield from ()",)  # makes a function a generator, whatever else stands in it
FOLLOW = ("yield from {}",)


class Way(NamedTuple):
    """One way to tell answers: lines of Python."""

    give: Callable[[Told], list[str]]  # for one answer
    begin: tuple[str, ...]
    end: tuple[str, ...]
    carried: tuple[str, ...]  # what all parts of the function need
    onward: tuple[str, ...]  # that go on in another part, {} for the call
    ending: tuple[str, ...]  # of every other part


def _give_dict(template: str) -> Callable[[Told], list[str]]:
    """Lines that give a dict, which stands for {} in TEMPLATE."""

    def give(told: Told) -> list[str]:
        pairs = ", ".join(f"{name}: {value}" for name, value in told.items())
        return [template.replace("{}", "{" + pairs + "}")]

    return give


def _give_alist(told: Told) -> list[str]:
    """Lines that give an alist. Calling Cons would take half as long again."""
    lines, rest = [], "None"
    for number, (name, value) in reversed(list(enumerate(told.items()))):
        lines += ["pair = new(Cons)", f"pair.car = {name}", f"pair.cdr = {value}"]
        lines += [f"l{number} = new(Cons)", f"l{number}.car = pair", f"l{number}.cdr = {rest}"]
        rest = f"l{number}"
    return [*lines, f"out.append({rest})"]


TO_LIST = (
    "rest = None",
    "for each in reversed(out):",
    "    cell = new(Cons)",
    "    cell.car = each",
    "    cell.cdr = rest",
    "    rest = cell",
    "return rest",
)

WAYS = {
    ALL: Way(_give_dict("out.append({})"), ("out = []",), ("return out",), ("out",), ("{}",), ()),
    ALISTS: Way(_give_alist, ("out = []",), TO_LIST, ("out",), ("{}",), ()),
    FIRST: Way(
        _give_dict("return {}"),
        (),
        ("return None",),
        (),
        ("found = {}", "if found is not None:", "    return found"),
        ("return None",),
    ),
    LAZY: Way(_give_dict("yield {}"), (), GENERATES, (), FOLLOW, GENERATES),
}
