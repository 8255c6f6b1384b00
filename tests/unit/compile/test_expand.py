"""Macro expansion: what goes wrong in an expander is the program's mistake, and nobody else's."""

from __future__ import annotations

import pytest

from eslang import EslError, Interpreter

BROKEN = '(defmacro broken (x) (error "no ~a" x))'


def diagnostic_of(text: str) -> str:
    """The name of the mistake in TEXT."""
    with pytest.raises(EslError) as caught:
        Interpreter(clock="virtual").eval(text)
    return caught.value.diagnostic.name


@pytest.mark.parametrize("expander", ['(error "no")', "(fail :no)", "(car 5)", "(nowhere)", "(+ 1 nil)"])
def test_a_failing_expander_is_a_mistake_of_the_program(expander: str) -> None:
    assert diagnostic_of(f"(defmacro broken () {expander}) (broken)") == "macro-failed"


def test_nobody_is_told_of_a_failure_in_an_expander() -> None:
    heard: list[str] = []
    interp = Interpreter(clock="virtual", listeners=[lambda event: heard.append(event.kind)])
    with pytest.raises(EslError):
        interp.eval(f"{BROKEN} (broken 1)")
    assert [kind for kind in heard if not kind.startswith("task-")] == []


def test_no_recovery_procedure_answers_an_expander() -> None:
    text = f"{BROKEN} (with-recovery-procedures ((:error (abort :asked-once))) (eval '(broken 1)))"
    heard: list[str] = []
    interp = Interpreter(clock="virtual", listeners=[lambda event: heard.append(event.kind)])
    assert str(interp.eval(text)) == ":ASKED-ONCE"
    assert [kind for kind in heard if not kind.startswith("task-")] == ["recovery", "recovery-ended"]


def test_an_expansion_without_end_is_refused() -> None:
    assert diagnostic_of("(defmacro again (x) `(again ,x)) (again 1)") == "nested-too-deep"
    assert diagnostic_of("(defmacro again (x) `(again ,x)) (list (again 1))") == "nested-too-deep"
