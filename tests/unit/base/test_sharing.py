"""Which parts of a structure are shared, and which contain themselves."""

from __future__ import annotations

from eslang.base.lists import Cons, lisp_list
from eslang.base.sharing import contains_itself, shared_parts
from eslang.base.text import Vector


def test_a_part_met_twice_is_shared() -> None:
    part = lisp_list(1)
    assert list(shared_parts(lisp_list(part, Vector([part])))) == [id(part)]
    assert shared_parts(lisp_list(lisp_list(1), lisp_list(1))) == {}


def test_sharing_alone_is_no_circle() -> None:
    part = lisp_list(1)
    assert not contains_itself(lisp_list(part, part))
    assert not contains_itself(Cons(part, part))


def test_a_circle_is_found_wherever_it_closes() -> None:
    ring = lisp_list(1, 2)
    ring.cdr.cdr = ring.cdr
    assert contains_itself(ring)
    inner = Vector([None])
    inner.items[0] = lisp_list(inner)
    assert contains_itself(lisp_list(1, inner))
