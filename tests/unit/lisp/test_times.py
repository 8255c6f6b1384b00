"""The time, on the clock of the interpreter."""

from __future__ import annotations

from support import lines_of


def test_virtual_time_is_what_a_plan_is_told() -> None:
    text = """
    (print internal-time-units-per-second)
    (sleep 1.5)
    (print (get-internal-real-time))
    (print (- (get-internal-run-time) (get-internal-real-time)))
    (sleep 10)
    (print (get-universal-time))
    """
    assert lines_of(text) == ["1000000", "1500000", "0", "3155673611"]


def test_a_condition_may_ask_the_time() -> None:
    text = """
    (spawn (sleep 5))
    (wait-until (>= (get-internal-real-time) 5000000))
    (print :five)
    """
    assert lines_of(text) == [":FIVE"]
