"""Hooks: what the kernel tells its listeners."""

from __future__ import annotations

from io import StringIO
from typing import Any

import pytest

from eslang import Failure, Interpreter
from eslang.runtime.hooks import SPOKEN, Event, Hooks


def test_every_listener_hears_every_event_in_order() -> None:
    heard: list[tuple[int, str]] = []
    hooks = Hooks(lambda: 2.5, lambda: "task")
    hooks.listeners += [
        lambda event: heard.append((1, event.kind)),
        lambda event: heard.append((2, event.kind)),
    ]
    hooks.tell("recovery")
    hooks.tell("failure")
    assert heard == [(1, "recovery"), (2, "recovery"), (1, "failure"), (2, "failure")]


def test_an_event_tells_when_where_and_what() -> None:
    heard: list[Event] = []
    hooks = Hooks(lambda: 2.5, lambda: "task")
    hooks.listeners.append(heard.append)
    hooks.tell("goal", "place", state="achieved")
    assert heard == [Event("goal", 2.5, "task", "place", {"state": "achieved"})]


def test_a_speaker_hears_only_what_the_papers_print() -> None:
    hooks = Hooks(lambda: 0.0, lambda: "task")
    heard: list[str] = []
    hooks.speakers.append(lambda event: heard.append(event.kind))
    for kind in ("wait", "recovery", "signal", "failure"):
        hooks.tell(kind)
    assert heard == ["recovery", "failure"]


def test_a_listener_may_leave_while_it_is_told() -> None:
    hooks = Hooks(lambda: 0.0, lambda: "task")
    heard: list[str] = []

    def once(event: Event) -> None:
        heard.append(event.kind)
        hooks.listeners.remove(once)

    hooks.listeners += [once, lambda event: heard.append("other")]
    hooks.tell("failure")
    hooks.tell("failure")
    assert heard == ["failure", "other", "other"]


def events_of(text: str) -> list[tuple[str, Any]]:
    """The events of a run of TEXT: kind, and what is telling about each."""
    heard: list[tuple[str, Any]] = []

    def listen(event: Event) -> None:
        left = event.data.get("left", event.data.get("state"))
        if event.kind in SPOKEN:
            heard.append((event.kind, left))

    with Interpreter(clock="virtual", output=StringIO(), listeners=[listen]) as interp:
        try:
            interp.eval(text)
        except Failure:
            heard.append(("raised", None))
    return heard


def test_a_failure_is_told_before_and_aborted_after_unwinding() -> None:
    assert events_of("(unwind-protect (fail :a) (with-recovery-procedures ((:b 1)) (fail :b)))") == [
        ("failure", None),
        ("recovery", 0),
        ("aborted", None),
        ("raised", None),
    ]


def test_retries_left_are_told_with_each_recovery() -> None:
    form = "(with-recovery-procedures ((:a :retries 2 (retry)) (:a :retries :infinite (abort))) (fail :a))"
    assert events_of(form) == [("recovery", 1), ("recovery", 0), ("recovery", None)]


def test_goals_are_told() -> None:
    text = "(defvar *ok* nil) (to-achieve *ok* (t (setq *ok* 1))) (achieve *ok*) (achieve *ok*)"
    assert [state for kind, state in events_of(text) if kind == "goal"] == [
        "attempting",
        "achieved",
        "no-action",
    ]


def test_a_place_in_the_source_comes_with_an_event() -> None:
    places: list[str] = []

    def listen(event: Event) -> None:
        if event.kind in ("recovery", "failure"):
            places.append(f"{event.kind} {event.form}")

    with Interpreter(clock="virtual", output=StringIO(), listeners=[listen]) as interp:
        interp.eval("(with-recovery-procedures\n  ((:a 1))\n  (fail :a))", name="plan.esl")
        with pytest.raises(Failure):
            interp.eval("\n (fail :b)", name="plan.esl")
    assert places == ["recovery plan.esl:2:4", "failure plan.esl:2:2"]
