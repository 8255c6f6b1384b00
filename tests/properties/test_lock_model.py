"""The table of property locks beside a model of it, step by step, whatever is done (ARM §4)."""

from __future__ import annotations

from io import StringIO
from typing import Any

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule
from locking.schedules import wrongs
from locking.world import World

from eslang import Interpreter
from eslang.runtime.events import Event

KEYS = ("p", "q")
INTERP = Interpreter(clock="virtual", output=StringIO())


class LockTable(RuleBasedStateMachine):
    """Tasks come, stay until they are told to go, and are aborted; the world spoils what they maintain.

    The model: for each property its subscribers in their order, each with the
    value that it wants and whether it waits for recoveries. Between two rules
    time passes, so that all that was begun is over.
    """

    @initialize(shuffled=st.booleans(), seed=st.integers(0, 99))
    def begin(self, shuffled: bool, seed: int) -> None:
        """A world of its own, and an empty model."""
        from random import Random

        INTERP.hooks.listeners.clear()
        chance = Random(seed)
        self.world = World(INTERP)
        self.world.scheduler.choose = (lambda ready: chance.randrange(len(ready))) if shuffled else None
        self.model: dict[str, list[tuple[str, str, bool]]] = {key: [] for key in KEYS}
        self.leave: dict[str, Event] = {}
        self.stuck: set[str] = set()
        self.count = 0
        for key in KEYS:
            self.world.recoveries[key] = self.recover

    def recover(self, one: Any) -> None:
        """Restore a property, unless that is to fail."""
        if one.key in self.stuck:
            self.world.fail("STUCK")
        self.world.switch(one)

    def settle(self) -> None:
        """Let time pass until all that was begun is over."""
        with INTERP.door():
            INTERP.runs.enter(lambda: self.world.sleep(50))

    @rule(key=st.sampled_from(KEYS), value=st.sampled_from("12?"), stays=st.booleans())
    def subscribe(self, key: str, value: str, stays: bool) -> None:
        """A task wants KEY to have VALUE; it STAYS when that is violated, or leaves."""
        self.count += 1
        name, event = f"t{self.count}", Event()
        world = self.world

        def inside() -> None:
            world.scheduler.wait_for(event)

        def body() -> None:
            wanted = f"{key}={value}"
            world.noting(
                lambda: world.tolerating(wanted, inside) if stays else world.maintain(wanted, inside)
            )

        with INTERP.door():
            INTERP.runs.enter(lambda: world.spawn(name, body) and None)
        self.settle()
        holders = self.model[key]
        if all(value == other or "?" in (value, other) for _, other, _ in holders):
            holders.append((name, value, stays))
            self.leave[name] = event

    def members(self) -> list[str]:
        """All that have a lock, in the order of the model."""
        return [name for holders in self.model.values() for name, _, _ in holders]

    def forget(self, gone: set[str]) -> None:
        """Take those that are GONE out of the model."""
        for key, holders in self.model.items():
            self.model[key] = [each for each in holders if each[0] not in gone]

    @precondition(lambda self: self.members())
    @rule(choice=st.integers(0, 99), aborted=st.booleans())
    def go(self, choice: int, aborted: bool) -> None:
        """A subscriber leaves its form, or is ABORTED."""
        names = self.members()
        name = names[choice % len(names)]
        with INTERP.door():
            if aborted:
                self.world.abort(name)
            else:
                self.world.scheduler.signal(self.leave[name], ())
        self.settle()
        self.forget({name})

    @rule(key=st.sampled_from(KEYS), stuck=st.booleans())
    def spoil(self, key: str, stuck: bool) -> None:
        """The world makes KEY have no value; if it is STUCK, it cannot be recovered."""
        self.stuck = {key} if stuck else set()
        with INTERP.door():
            self.world.set(key, None)
        self.settle()
        holders = self.model[key]
        self.forget({name for name, _, stays in holders if stuck or not stays})
        self.stuck = set()

    @invariant()
    def table_is_as_the_model_has_it(self) -> None:
        """Subscribers, their order, the owner, and what holds."""
        if not hasattr(self, "world"):
            return
        table = self.world.locks.locks
        assert wrongs(self.world) == []
        assert {key: holders for key, holders in self.model.items() if holders}.keys() == table.keys()
        for key, lock in table.items():
            names = [each.task.name.partition(".")[0] for each in lock.subscriptions]
            assert names == [name for name, _, _ in self.model[key]]
            assert lock.owner is self.world.tasks[names[0]]
            assert lock.busy is None
            for claim in lock.claims:
                assert claim.standing == "achieved"
                assert self.world.holds(claim.property)
        assert self.world.keeper.daemon is None

    def teardown(self) -> None:
        """Nothing is left when all have gone."""
        with INTERP.door():
            INTERP.runs.abort_all()
        left = self.world.remains() if hasattr(self, "world") else []
        assert not left, left


TestLockTable = pytest.mark.slow(LockTable.TestCase)
TestLockTable.settings = settings(max_examples=60, stateful_step_count=25, deadline=None)
