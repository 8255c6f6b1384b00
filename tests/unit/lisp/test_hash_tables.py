"""Hash tables."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from values import call, char, fails, fn, lisp, many, python, raw, symbol

from eslang.base.lists import Cons
from eslang.base.printer import prin1
from eslang.base.ratios import Ratio

atoms = st.integers(-3, 3) | st.floats(-3, 3, width=16) | st.text("aB", max_size=2) | st.booleans()
trees = st.recursive(atoms, lambda part: st.lists(part, max_size=3), max_leaves=5)


def table(test: str = "eql", **entries: Any) -> Any:
    """A hash table with the symbols ENTRIES as keys."""
    made = raw("make-hash-table", test=symbol(test))
    for name, value in entries.items():
        call("%set-gethash", symbol(name), made, value)
    return made


def test_gethash_tells_whether_the_key_is_there() -> None:
    made = table(a=1, b=None)
    assert many("gethash", symbol("a"), made) == [1, True]
    assert many("gethash", symbol("b"), made) == [None, True]
    assert many("gethash", symbol("c"), made, 9) == [9, None]
    assert call("gethash", symbol("c"), made, 9) == 9
    assert call("gethash", symbol("b"), made, 9) is None


def test_setting_may_name_a_default() -> None:
    made = table()
    assert call("%set-gethash", 1, made, 0, "x") == "x"
    assert call("gethash", 1, made) == "x"


def test_numbers_of_different_types_are_different_keys() -> None:
    for test in ("eq", "eql", "equal"):
        made = table(test)
        for key in (1, 1.0, Ratio(1, 2), 0.5, 0.0, -0.0):
            call("%set-gethash", key, made, str(key))
        assert [call("gethash", key, made) for key in (1, 1.0, Ratio(1, 2), 0.5)] == [
            "1",
            "1.0",
            "1/2",
            "0.5",
        ]
        assert call("hash-table-count", made) == 6


@pytest.mark.parametrize("test", ["eql", "equal", "equalp"])
@given(first=trees, second=trees)
def test_a_key_is_found_by_what_is_the_same_under_the_test(test: str, first: Any, second: Any) -> None:
    made = table(test)
    key = lisp(first)
    call("%set-gethash", key, made, "found")
    assert call("gethash", key, made) == "found"
    other = lisp(second)
    assert (call("gethash", other, made) == "found") == (call(test, key, other) is True)


def test_keys_come_back_as_they_were_given() -> None:
    made = table("equal")
    key = lisp(["a", 1.5])
    call("%set-gethash", key, made, 1)
    call("%set-gethash", lisp(["a", 1.5]), made, 2)
    assert raw("%hash-table-keys", made).car is key
    assert python(raw("%hash-table-pairs", made)) == [[["a", 1.5], ".", 2]]


def test_equalp_looks_into_arrays() -> None:
    made = table("equalp")
    call("%set-gethash", (1, "A"), made, "vector")
    assert call("gethash", (1.0, "a"), made) == "vector"
    call("%set-gethash", "abc", made, "string")
    assert call("gethash", (char("A"), char("b"), char("c")), made) == "string"


def test_foreign_objects_are_their_own_keys() -> None:
    class Foreign(list[int]):
        """Unhashable, and equal to others."""

    first, second = Foreign(), Foreign()
    made = fn("make-hash-table")()
    fn("%set-gethash")(first, made, 1)
    assert fn("gethash")(first, made) == 1
    assert fn("gethash")(second, made) is None


@pytest.mark.slow
def test_deep_keys_do_not_exhaust_the_stack() -> None:
    tree: object = 1
    for _ in range(100_000):
        tree = Cons(tree, None)
    made = table("equal")
    call("%set-gethash", tree, made, "deep")
    assert fn("gethash")(fn("copy-tree")(tree), made).text == "deep"


def test_tables_are_walked_in_the_order_of_insertion() -> None:
    made = table(c=1, a=2, b=3)
    call("remhash", symbol("a"), made)
    call("%set-gethash", symbol("a"), made, 4)
    call("%set-gethash", symbol("c"), made, 5)
    seen: list[tuple[Any, int]] = []
    assert call("maphash", lambda key, value: seen.append((key, value)), made) is None
    assert seen == [(symbol("c"), 5), (symbol("b"), 3), (symbol("a"), 4)]
    assert call("%hash-table-values", made) == [5, 3, 4]


def test_a_walk_may_remove_and_add() -> None:
    made = table(a=1, b=2)

    def change(key: Any, value: int) -> None:
        call("remhash", key, made)
        call("%set-gethash", value, made, value)

    call("maphash", change, made)
    assert call("%hash-table-keys", made) == [1, 2]


def test_a_table_prints_its_test_and_size() -> None:
    assert prin1(table("equal", a=1)) == "#<HASH-TABLE :TEST EQUAL :COUNT 1>"


def test_removing_and_clearing() -> None:
    made = table("equal")
    call("%set-gethash", "a", made, 1)
    assert call("remhash", "a", made) is True
    assert call("remhash", "a", made) is None
    call("%set-gethash", "a", made, 1)
    assert raw("clrhash", made) is made
    assert call("hash-table-count", made) == 0


def test_the_test_may_be_a_function() -> None:
    for name in ("eq", "eql", "equal", "equalp"):
        assert call("hash-table-test", raw("make-hash-table", test=fn(name), size=10)) is symbol(name)
    with fails("ERROR"):
        call("make-hash-table", test=fn("car"))
    with fails("ERROR"):
        call("make-hash-table", test=symbol("foo"))


def test_what_is_no_table_is_a_type_error() -> None:
    assert call("hash-table-p", table()) is True
    assert call("hash-table-p", [1]) is None
    for name in ("gethash", "remhash"):
        with fails("TYPE-ERROR"):
            call(name, 1, 2)
    for name in ("hash-table-count", "clrhash", "hash-table-test"):
        with fails("TYPE-ERROR"):
            call(name, 2)


@given(trees)
def test_what_is_equal_has_the_same_sxhash(tree: Any) -> None:
    assert call("sxhash", lisp(tree)) == call("sxhash", lisp(tree)) >= 0


def test_sxhash_is_the_same_in_every_run() -> None:
    program = (
        "from eslang.base.symbols import Keyword; from eslang.base.text import String;"
        "from eslang.base.lists import lisp_list; from eslang.lisp.hash_tables import sxhash;"
        "print(sxhash(lisp_list(1, 2.5, Keyword('a'), String('x'))))"
    )
    answers = {
        subprocess.run(
            [sys.executable, "-c", program],
            env={"PYTHONHASHSEED": seed},
            cwd=Path(__file__).parents[3],
            capture_output=True,
            check=True,
        ).stdout
        for seed in ("1", "2")
    }
    assert len(answers) == 1
