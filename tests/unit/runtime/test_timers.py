"""Timers: in the order of their moments, and called off for good."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from eslang.runtime.timers import FEW, Timers


def test_timers_of_one_moment_come_in_the_order_in_which_they_were_set() -> None:
    timers, came = Timers(), []
    for name in "abc":
        timers.set(1.0, lambda name=name: came.append(name))
    assert timers.fire(1.0)
    assert came == ["a", "b", "c"]


def test_a_timer_that_is_not_due_stays() -> None:
    timers = Timers()
    timers.set(2.0, lambda: None)
    assert not timers.fire(1.0)
    assert (len(timers), timers.next_moment()) == (1, 2.0)


def test_a_timer_is_called_off_once() -> None:
    timers = Timers()
    timer, _ = timers.set(1.0, lambda: None), timers.set(2.0, lambda: None)
    timers.call_off(timer)
    timers.call_off(timer)
    assert (len(timers), timers.next_moment()) == (1, 2.0)


def test_a_timer_that_has_come_cannot_be_called_off() -> None:
    timers = Timers()
    timer = timers.set(1.0, lambda: None)
    timers.fire(1.0)
    timers.call_off(timer)
    assert (len(timers), timers.next_moment()) == (0, None)


def test_a_timer_may_set_and_call_off_others() -> None:
    timers, came = Timers(), []
    timers.set(1.0, lambda: (timers.call_off(second), timers.set(1.0, lambda: came.append("new"))))
    second = timers.set(1.0, lambda: came.append("second"))
    timers.fire(1.0)
    assert came == ["new"]


def test_timers_that_were_called_off_do_not_pile_up() -> None:
    timers = Timers()
    for moment in range(10_000):
        timers.call_off(timers.set(float(moment), lambda: None))
    assert len(timers) == 0
    assert len(timers.heap) <= 2 * FEW + 2


@given(st.lists(st.tuples(st.integers(0, 5), st.booleans()), max_size=40), st.integers(0, 5))
def test_what_comes_is_what_was_set_and_is_due_and_not_called_off(wanted: list, now: int) -> None:
    timers, came = Timers(), []
    made = [timers.set(float(moment), lambda n=n: came.append(n)) for n, (moment, _) in enumerate(wanted)]
    for timer, (_, off) in zip(made, wanted, strict=True):
        if off:
            timers.call_off(timer)
    timers.fire(float(now))
    due = [(moment, n) for n, (moment, off) in enumerate(wanted) if moment <= now and not off]
    assert came == [n for _, n in sorted(due)]
    assert len(timers) == sum(not off for _, off in wanted) - len(came)
