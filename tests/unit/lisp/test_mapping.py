"""MAPCAR and its siblings."""

from __future__ import annotations

from values import call, fails, fn, lisp, raw


def test_mapcar_goes_as_far_as_the_shortest_list() -> None:
    assert call("mapcar", lambda x: x + 1, [1, 2]) == [2, 3]
    assert call("mapcar", lambda x, y: x + y, [1, 2, 3], [10, 20]) == [11, 22]
    assert call("mapcar", lambda x: x, None) is None


def test_mapc_returns_its_first_list() -> None:
    seen: list[int] = []
    lst = lisp([1, 2])
    assert raw("mapc", lambda x: seen.append(x), lst) is lst
    assert raw("mapc", lambda x, y: seen.append(x + y), lst, [10]) is lst
    assert seen == [1, 2, 11]


def test_mapcan_and_mapcon_join_their_results() -> None:
    assert call("mapcan", fn("list"), [1, 2], ["a", "b"]) == [1, "a", 2, "b"]
    assert call("mapcan", lambda x: [x] if x > 1 else None, [1, 2, 3]) == [2, 3]
    assert call("mapcon", fn("copy-list"), [1, 2]) == [1, 2, 2]


def test_maplist_and_mapl_get_the_tails() -> None:
    assert call("maplist", fn("copy-list"), [1, 2]) == [[1, 2], [2]]
    lst = lisp([1, 2])
    assert raw("mapl", fn("car"), lst) is lst


def test_what_is_no_list_is_a_type_error() -> None:
    for name in ("mapcar", "mapc", "mapcan", "maplist"):
        with fails("TYPE-ERROR"):
            call(name, fn("list"), 5)
        with fails("TYPE-ERROR"):
            call(name, fn("list"), raw("cons", 1, 2))
        with fails("TYPE-ERROR"):
            call(name, fn("list"), [1, 2], raw("cons", 1, 2))
