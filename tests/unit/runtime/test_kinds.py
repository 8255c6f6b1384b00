"""Kinds: one table of all that listeners hear of, and nothing else is told."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import Any

from locking.world import World
from unit.tools.traced import EVERY_KIND, RESCUE, told

from architecture.sources import MODULES
from eslang import Failure, Keyword
from eslang.runtime.events import Event
from eslang.runtime.hooks import SPOKEN
from eslang.runtime.kinds import KINDS, TABLE
from eslang.runtime.story import Place
from eslang.runtime.tasks import Task

CLASSES = {
    "Task": Task,
    "Event": Event,
    "Failure": Failure,
    "Keyword": Keyword,
    "Place": Place,
    "str": str,
    "bool": bool,
    "int": int,
    "float": (int, float),
    "tuple[Waiting, ...]": tuple,
}


def told_of_a_lock() -> list[Any]:
    """The events of a property lock that is taken, and left."""
    heard: list[Any] = []
    world = World(listeners=[heard.append])
    world.run(a=world.hold("p=1"))
    return heard


def tells() -> Iterator[tuple[str, set[str], str]]:
    """Every place in the source that tells something: the kind, the parts, where."""
    for module in MODULES:
        for node in ast.walk(module.tree):
            if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Attribute) or not node.args:
                continue
            kind = node.args[0]
            if node.func.attr == "tell" and isinstance(kind, ast.Constant) and isinstance(kind.value, str):
                parts = {keyword.arg for keyword in node.keywords if keyword.arg is not None}
                yield kind.value, parts, f"{module.place}:{node.lineno}"


def test_all_that_is_told_stands_in_the_table_with_its_parts() -> None:
    wrong = [
        f"{place} {kind} {sorted(parts)}"
        for kind, parts, place in tells()
        if kind not in KINDS or parts != {part.name for part in KINDS[kind].parts}
    ]
    assert wrong == []


def test_all_that_stands_in_the_table_is_told_somewhere() -> None:
    assert {kind for kind, _, _ in tells()} == set(KINDS)
    assert len(TABLE) == len(KINDS)


def test_what_the_papers_print_is_in_the_table() -> None:
    assert set(SPOKEN) <= set(KINDS)


def test_the_parts_are_of_the_types_that_the_table_says() -> None:
    wrong = []
    for event in told(RESCUE) + told(EVERY_KIND) + told_of_a_lock():
        for part in KINDS[event.kind].parts:
            value = event.data[part.name]
            kind = part.type.removesuffix(" | None")
            fits = kind not in CLASSES or isinstance(value, CLASSES[kind])
            if not (fits or (value is None and part.type.endswith("| None"))):
                wrong.append(f"{event.kind} {part.name}: {value!r} is no {part.type}")
    assert wrong == []


def test_two_plans_tell_every_kind() -> None:
    heard = {event.kind for event in told(RESCUE) + told(EVERY_KIND) + told_of_a_lock()}
    assert set(KINDS) - heard == set()


def test_a_net_that_fails_tells_both_ends() -> None:
    heard = told("(task-net (left (sleep 1) (fail :no-power 3)) (right (sleep 2)))")
    failed = next(event for event in heard if event.kind == "failure")
    passed = next(event for event in heard if event.kind == "failure-passed")
    last = [event for event in heard if event.kind == "failure"][-1]
    assert (failed.task.name, passed.task.name, passed.data["of"].name) == ("left", "main", "left")
    assert last.task.name == "main"
    assert last.data["failure"].origin is passed.data["of"]
    assert str(passed.form) == "plan.esl:1:1"


def test_every_wait_that_begins_ends() -> None:
    heard = told(RESCUE)
    waits = [event.task.name for event in heard if event.kind == "wait"]
    resumes = [event.task.name for event in heard if event.kind == "resume"]
    assert sorted(waits) == sorted(resumes)


def test_how_a_wait_ended_is_told() -> None:
    text = "(with-recovery-procedures ((:timeout (abort 1))) (wait-until nil :timeout 2))" + RESCUE
    assert {event.data["how"] for event in told(text) if event.kind == "resume"} == {
        "came",
        "timeout",
        "left",
    }


def test_who_aborts_whom_is_told() -> None:
    heard = told("(or-parallel (progn (sleep 5) 1) (progn (sleep 2) 2))")
    abort = next(event for event in heard if event.kind == "abort")
    assert (abort.data["of"].name, abort.data["why"], abort.data["by"].name) == ("sleep", "net", "sleep.2")


def test_an_interrupt_tells_whom_it_comes_from() -> None:
    heard = told("(with-guardian (sleep 1) (princ :alarm) (sleep 3))")
    sent = next(event for event in heard if event.kind == "interrupt-sent")
    came = next(event for event in heard if event.kind == "interrupt")
    assert (sent.data["to"].name, sent.data["why"], sent.data["by"].name) == ("main", "guardian", "sleep")
    assert (came.task.name, came.data["by"]) == ("main", sent.data["by"])


def test_how_a_recovery_ended_is_told() -> None:
    ways = {
        "(retry)": "retry",
        "(abort 1)": "abort",
        "2": "continued",
        "(return-from out 1)": "left",
    }
    for body, how in ways.items():
        heard = told(f"(block out (with-recovery-procedures ((:x {body})) (fail :x)))")
        assert [event.data["how"] for event in heard if event.kind == "recovery-ended"] == [how]
    heard = told("(with-recovery-procedures ((:error 1)) (car 5))")
    assert [event.data["how"] for event in heard if event.kind == "recovery-ended"] == ["declined"]


def test_where_a_host_error_came_about_is_told_with_its_recovery() -> None:
    heard = told("(with-recovery-procedures ((:error (abort 1)))\n  (list 1\n    (car 5)))")
    recovery = next(event for event in heard if event.kind == "recovery")
    assert str(recovery.data["raised"]) == "plan.esl:3:5"


def test_a_deadlock_tells_who_waits_for_what() -> None:
    heard = told("(task-net (a (checkpoint-wait b :x)) (b (checkpoint-wait a :x)))")
    deadlock = next(event for event in heard if event.kind == "deadlock")
    assert [each.task for each in deadlock.data["waiting"]] == ["main", "a", "b"]
