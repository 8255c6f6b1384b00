"""Trees of conses."""

from __future__ import annotations

import pytest
from values import call, fn, lisp, raw, symbol

from eslang.base.lists import Cons, from_items

A, B, C, X = (symbol(name) for name in "abcx")
TREE = [A, [B, A], C]


def pairs(*entries: tuple[object, object]) -> object:
    """An association list of ENTRIES."""
    return from_items([Cons(key, value) for key, value in entries])


def test_subst_replaces_every_matching_part() -> None:
    assert call("subst", X, A, TREE) == [X, [B, X], C]
    assert call("subst", X, A, raw("cons", B, A)) == [B, ".", X]
    assert call("subst", X, A, A) is X
    assert call("subst", X, lisp([B, A]), TREE, test=fn("equal")) == [A, X, C]
    assert call("subst", X, 2, [1, 2], key=lambda part: 2 if part == 1 else None) == [X, 2]


def test_subst_leaves_the_tree_and_nsubst_changes_it() -> None:
    tree = lisp(TREE)
    raw("subst", X, A, tree)
    assert call("list*", tree) == TREE
    assert raw("nsubst", X, A, tree) is tree
    assert call("list*", tree) == [X, [B, X], C]


def test_subst_by_predicate() -> None:
    def is_number(part: object) -> bool:
        return isinstance(part, int)

    assert call("subst-if", 0, is_number, [1, [A, 2]]) == [0, [A, 0]]
    assert call("nsubst-if", 0, is_number, [1, [A, 2]]) == [0, [A, 0]]
    assert call("subst-if-not", 0, lambda part: part.__class__ is Cons, [1]) == [0, ".", 0]
    assert call("nsubst-if-not", 0, lambda part: part.__class__ is Cons, [1]) == [0, ".", 0]


def test_what_was_put_in_is_not_searched() -> None:
    assert call("subst", lisp([A, A]), A, [A, B]) == [[A, A], B]


def test_sublis_replaces_by_an_alist() -> None:
    assert call("sublis", pairs((A, 1), (B, 2)), TREE) == [1, [2, 1], C]
    assert call("nsublis", pairs((A, 1), (A, 5)), TREE) == [1, [B, 1], C]


def test_tree_equal_compares_shape_and_leaves() -> None:
    assert call("tree-equal", TREE, TREE) is True
    assert call("tree-equal", [1, [2]], [1, 2]) is None
    assert call("tree-equal", ["a"], ["a"]) is None
    assert call("tree-equal", ["a"], ["a"], test=fn("equal")) is True


def test_copy_tree_shares_no_cons() -> None:
    tree = lisp(TREE)
    copy = raw("copy-tree", tree)
    assert call("equal", copy, tree) is True
    assert copy is not tree
    assert copy.cdr.car is not tree.cdr.car


@pytest.mark.slow
def test_depth_is_bounded_by_memory_alone() -> None:
    tree: object = A
    for _ in range(100_000):
        tree = Cons(tree, None)
    copy = raw("copy-tree", tree)
    assert call("tree-equal", copy, tree) is True
    assert call("tree-equal", raw("subst", X, A, tree), copy) is None
