"""Sameness and kinds."""

from __future__ import annotations

import pytest
from values import call, char, lisp, symbol

from eslang.base.lists import Cons
from eslang.base.ratios import Ratio
from eslang.base.symbols import Keyword

A = symbol("a")


@pytest.mark.parametrize(
    ("test", "x", "y", "same"),
    [
        ("eq", A, A, True),
        ("eq", 10**20, 10**20, True),
        ("eql", 1, 1.0, False),
        ("eql", 1.5, 1.5, True),
        ("eql", 0.0, -0.0, False),
        ("eql", Ratio(2, 3), Ratio(2, 3), True),
        ("eql", "a", "a", False),
        ("equal", "a", "a", True),
        ("equal", "a", "A", False),
        ("equal", 1, 1.0, False),
        ("equal", [1, "x", [2]], [1, "x", [2]], True),
        ("equal", [1, [2]], [1, [3]], False),
        ("equal", [1], [1, 2], False),
        ("equal", [[1]], [1], False),
        ("equal", (1,), (1,), False),
        ("equalp", 1, 1.0, True),
        ("equalp", 0.0, -0.0, True),
        ("equalp", (1, "A"), (1.0, "a"), True),
        ("equalp", "abc", (char("A"), char("b"), char("C")), True),
        ("equalp", (1, 2), (1,), False),
        ("equalp", [["x"], 2], [["X"], 2.0], True),
        ("equalp", A, Keyword("a"), False),
    ],
)
def test_sameness(test: str, x: object, y: object, same: bool) -> None:
    assert (call(test, x, y) is True) is same


@pytest.mark.slow
def test_deep_structures_are_compared_without_recursion() -> None:
    def deep(bottom: int) -> object:
        tree: object = bottom
        for _ in range(100_000):
            tree = Cons(tree, None)
        return tree

    assert call("equal", deep(1), deep(1)) is True
    assert call("equal", deep(1), deep(2)) is None
    assert call("equalp", deep(1), deep(1.0)) is True
    assert call("equal", list(range(100_000)), list(range(100_000))) is True


def test_a_table_is_equalp_to_one_with_the_same_entries() -> None:
    first, second = call("make-hash-table"), call("make-hash-table")
    call("%set-gethash", 1, first, "x")
    assert call("equalp", first, second) is None
    call("%set-gethash", 1, second, "X")
    assert call("equalp", first, second) is True


@pytest.mark.parametrize(
    ("value", "claims"),
    [
        (None, "null not listp symbolp atom"),
        (A, "symbolp atom"),
        (Keyword("a"), "symbolp keywordp atom"),
        ([1], "consp listp"),
        (1, "numberp realp rationalp integerp atom"),
        (1.0, "numberp realp floatp atom"),
        (Ratio(1, 2), "numberp realp rationalp atom"),
        ("a", "stringp simple-string-p vectorp arrayp atom"),
        ((1,), "vectorp simple-vector-p arrayp atom"),
        (char("a"), "characterp atom"),
        (len, "functionp compiled-function-p atom"),
    ],
)
def test_each_value_is_what_it_is_and_nothing_else(value: object, claims: str) -> None:
    names = (
        "null not listp symbolp keywordp atom consp numberp realp rationalp integerp floatp complexp stringp "
        "simple-string-p vectorp simple-vector-p arrayp characterp functionp compiled-function-p packagep"
    )
    assert [name for name in names.split() if call(name, lisp(value))] == [
        name for name in names.split() if name in claims.split()
    ]
