"""Trees of conses: copying, comparing, substituting.

All go along both car and cdr with a stack of their own, so that a tree may be
as deep as memory allows.
"""

from __future__ import annotations

from eslang.base.arguments import UNSUPPLIED, take_keys
from eslang.base.hints import Callable
from eslang.base.lists import Cons, items
from eslang.base.symbols import Value, truth
from eslang.compile.registry import function
from eslang.lisp.conses import car
from eslang.lisp.matching import Choice, agreement, judge_if, judge_item

_TESTS = ("TEST", "TEST-NOT", "KEY")
_KEY = ("KEY",)


def _rebuild(tree: Value, replace: Callable[[Value], Value], *, copy: bool = True) -> Value:
    """TREE (or a copy) with what REPLACE makes of each subtree, unless that is UNSUPPLIED."""
    root = Cons(tree, None)
    pending = [(root, True)]
    while pending:
        cell, in_car = pending.pop()
        value = cell.car if in_car else cell.cdr
        new = replace(value)
        if new is UNSUPPLIED:
            if value.__class__ is not Cons:
                continue
            new = Cons(value.car, value.cdr) if copy else value
            pending.append((new, False))
            pending.append((new, True))
        if in_car:
            cell.car = new
        else:
            cell.cdr = new
    return root.car


@function("(copy-tree tree)")
def copy_tree(tree: Value) -> Value:
    """Return a copy of TREE down to its atoms."""
    return _rebuild(tree, lambda value: UNSUPPLIED)


def _substitute(new: Value, tree: Value, choice: Choice, *, copy: bool = True) -> Value:
    """TREE with NEW for each subtree that the judge accepts."""
    judge, sign = choice
    return _rebuild(tree, lambda value: new if (judge(value) is not None) is sign else UNSUPPLIED, copy=copy)


@function("(subst new old tree &key test test-not key)")
def subst(new: Value, old: Value, tree: Value, *options: Value) -> Value:
    """Return a copy of TREE with NEW for each part that matches OLD."""
    return _substitute(new, tree, judge_item(old, *take_keys(options, _TESTS)))


@function("(subst-if new predicate tree &key key)")
def subst_if(new: Value, predicate: Value, tree: Value, *options: Value) -> Value:
    """Return a copy of TREE with NEW for each part that satisfies PREDICATE."""
    return _substitute(new, tree, judge_if(predicate, True, *take_keys(options, _KEY)))


@function("(subst-if-not new predicate tree &key key)")
def subst_if_not(new: Value, predicate: Value, tree: Value, *options: Value) -> Value:
    """Return a copy of TREE with NEW for each part that fails PREDICATE."""
    return _substitute(new, tree, judge_if(predicate, False, *take_keys(options, _KEY)))


@function("(nsubst new old tree &key test test-not key)")
def nsubst(new: Value, old: Value, tree: Value, *options: Value) -> Value:
    """Change TREE so that NEW stands for each part that matches OLD."""
    return _substitute(new, tree, judge_item(old, *take_keys(options, _TESTS)), copy=False)


@function("(nsubst-if new predicate tree &key key)")
def nsubst_if(new: Value, predicate: Value, tree: Value, *options: Value) -> Value:
    """Change TREE so that NEW stands for each part that satisfies PREDICATE."""
    return _substitute(new, tree, judge_if(predicate, True, *take_keys(options, _KEY)), copy=False)


@function("(nsubst-if-not new predicate tree &key key)")
def nsubst_if_not(new: Value, predicate: Value, tree: Value, *options: Value) -> Value:
    """Change TREE so that NEW stands for each part that fails PREDICATE."""
    return _substitute(new, tree, judge_if(predicate, False, *take_keys(options, _KEY)), copy=False)


def _from_alist(alist: Value, options: tuple[Value, ...]) -> Callable[[Value], Value]:
    """What SUBLIS puts in the place of a subtree."""
    test, test_not, key = take_keys(options, _TESTS)
    choices = []
    for entry in items(alist):
        if entry is not None:
            judge, sign = judge_item(car(entry), test, test_not, key)
            choices.append((judge, sign, entry.cdr))

    def replace(value: Value) -> Value:
        for judge, sign, new in choices:
            if (judge(value) is not None) is sign:
                return new
        return UNSUPPLIED

    return replace


@function("(sublis alist tree &key test test-not key)")
def sublis(alist: Value, tree: Value, *options: Value) -> Value:
    """Return a copy of TREE with what ALIST holds for its parts."""
    return _rebuild(tree, _from_alist(alist, options))


@function("(nsublis alist tree &key test test-not key)")
def nsublis(alist: Value, tree: Value, *options: Value) -> Value:
    """Change TREE so that what ALIST holds stands for its parts."""
    return _rebuild(tree, _from_alist(alist, options), copy=False)


@function("(tree-equal tree-1 tree-2 &key test test-not)")
def tree_equal(first: Value, second: Value, *options: Value) -> Value:
    """True if TREE-1 and TREE-2 have the same shape and matching leaves."""
    agrees = agreement(*take_keys(options, ("TEST", "TEST-NOT")))
    pending = [(first, second)]
    while pending:
        a, b = pending.pop()
        if a.__class__ is Cons and b.__class__ is Cons:
            pending.append((a.cdr, b.cdr))
            pending.append((a.car, b.car))
        elif a.__class__ is Cons or b.__class__ is Cons or not agrees(a, b):
            return truth(False)
    return truth(True)
