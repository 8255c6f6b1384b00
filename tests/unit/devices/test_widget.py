"""Widgets: one that has no name, and any number of others."""

from __future__ import annotations

import pytest

from support import lines_of, run


@pytest.mark.parametrize("name", ["'w1", '"w1"', ":w1", "7", "'(arm (2))"])
def test_a_widget_may_have_a_name_of_any_kind(name: str) -> None:
    text = f"""
    (break-widget :broken {name})
    (operate-widget)
    (with-recovery-procedures (((:widget-broken which) (princ (equal which {name})) (abort)))
      (operate-widget {name}))
    (attempt-widget-fix :broken {name})
    (operate-widget {name})
    """
    ok = "OPERATING WIDGET SUCCESSFULLY."
    assert lines_of(text) == [ok, "T", "Widget is fixed.", ok]


def test_the_widget_without_a_name_is_the_one_of_the_variable() -> None:
    assert lines_of("(break-widget) (print *widget-status*) (setq *widget-status* :ok) (operate-widget)") == [
        ":BROKEN",
        "OPERATING WIDGET SUCCESSFULLY.",
    ]


def test_the_values_are_those_of_the_paper() -> None:
    text = """(print (list (operate-widget) (break-widget) (attempt-widget-fix :wrong)
                           (attempt-widget-fix :broken) (break-widget :severely-broken) *widget-status*))"""
    assert lines_of(text)[-1] == "(NIL :BROKEN NIL NIL :SEVERELY-BROKEN :SEVERELY-BROKEN)"


def test_a_monitor_of_a_broken_widget_returns_its_state() -> None:
    assert lines_of("(break-widget :worn) (print (monitor-widget))") == [":WORN"]


def test_a_monitor_that_nothing_could_wake_is_a_deadlock() -> None:
    assert str(run("(monitor-widget)").failure.cause) == ":DEADLOCK"
