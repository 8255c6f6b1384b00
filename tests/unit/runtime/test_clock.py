"""Clocks: virtual time passes only when it is told to."""

from __future__ import annotations

import pytest

from eslang.runtime.clock import SLICE, RealClock, VirtualClock, make_clock


def test_virtual_time_begins_at_nought_and_jumps() -> None:
    clock = VirtualClock()
    assert clock.now() == 0.0
    clock.advance(86_400.0)
    clock.use_slice()
    assert clock.now() == 86_400.0 + SLICE


@pytest.mark.parametrize("kind", ["virtual", "real"])
def test_time_never_goes_back(kind: str) -> None:
    clock = make_clock(kind)
    before = clock.now()
    clock.advance(before - 5.0)
    clock.use_slice()
    assert clock.now() >= before >= 0.0


def test_a_clock_has_one_of_two_kinds() -> None:
    assert isinstance(make_clock("virtual"), VirtualClock)
    assert isinstance(make_clock("real"), RealClock)
    with pytest.raises(ValueError, match="`lunar`"):
        make_clock("lunar")
