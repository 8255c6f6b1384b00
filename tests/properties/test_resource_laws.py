"""The laws of resources, on plans that take, wait, give way, fail and are aborted."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from eslang.runtime.resources import Holding, Resource
from trees.remains import remains
from trees.running import Run

pytestmark = pytest.mark.slow
Run().interp.close()  # it raises the limit of recursion, which Hypothesis would notice in a test
CAPACITY = 10
CLAIMS = st.tuples(
    st.integers(1, CAPACITY),  # amount
    st.integers(0, 3),  # priority
    st.integers(0, 5),  # when it comes
    st.integers(0, 5),  # how long it holds
    st.sampled_from(["", "(fail :broken)", "(abort-task (current-task))"]),
    st.integers(0, 3),  # how long its cleanup takes
)
SETTINGS = """
(define-resource power :capacity 10)
(defmacro claim (amount priority comes holds end cleanup)
  `(progn (sleep ,comes)
          (with-resource (power ,amount) :priority ,priority
            (with-cleanup-procedure (sleep ,cleanup) (sleep ,holds) ,end))))
"""


class Watched(Resource):
    """A resource that says what the laws say at each moment at which something changes."""

    __slots__ = ("served",)

    def grant(self, scheduler: Any) -> None:
        """Give, and check."""
        waiting = list(self.line)
        super().grant(scheduler)
        assert self.left == self.capacity - sum(each.amount for each in self.holdings) >= 0
        assert all(each.task.status is None for each in (*self.holdings, *self.line))
        served = [each for each in waiting if each.is_granted]
        assert served == waiting[: len(served)], "somebody was overtaken"
        assert self.line == sorted(self.line, key=rank), "the line is out of order"
        assert not self.line or self.line[0].amount > self.left, "what could be given was not"


ORDER: dict[Holding, int] = {}


def rank(holding: Holding) -> tuple[int, int]:
    """Where it belongs in the line: by importance, then as it came."""
    return -holding.priority, ORDER.setdefault(holding, len(ORDER))


@given(st.lists(CLAIMS, min_size=1, max_size=7), st.integers(0, 1000))
@settings(max_examples=50, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])
def test_never_more_than_there_is_in_order_and_all_comes_back(claims: list[Any], seed: int) -> None:
    ORDER.clear()
    members = " ".join(
        f"(t{number} (claim {' '.join(str(part) or 'nil' for part in claim)}))"
        for number, claim in enumerate(claims)
    )
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("eslang.constructs.esl.resources.Resource", Watched)
        run = Run(seed=seed, shuffle=True).evaluate(f"{SETTINGS} (task-net :allow-failures {members})")
    assert remains(run) == []
    (power,) = run.interp.resources.values()
    assert (power.left, power.holdings, power.line) == (CAPACITY, [], [])
