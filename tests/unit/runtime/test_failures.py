"""Failures: who answers them, in which order, and what a jump out of a body sets off."""

from __future__ import annotations

from io import StringIO
from typing import Any

import pytest

from eslang import Failure, Interpreter
from eslang.base.control import Stop
from eslang.base.failure import ERROR, TYPE_ERROR
from eslang.base.symbols import Keyword
from eslang.runtime.failures import Causes
from support import lines_of, run


@pytest.fixture
def interp() -> Any:
    with Interpreter(clock="virtual", output=StringIO()) as made:
        yield made


# --- the hierarchy of causes -----------------------------------------------------------


def test_a_host_cause_is_an_error() -> None:
    assert Causes().answers(ERROR, TYPE_ERROR)


def test_a_parent_takes_the_failures_of_its_children_and_not_the_other_way() -> None:
    causes = Causes()
    lost, hardware, trouble = map(Keyword, ("LOST", "HARDWARE", "TROUBLE"))
    causes.define(lost, (hardware,))
    causes.define(hardware, (trouble,))
    assert causes.answers(trouble, lost)
    assert not causes.answers(lost, trouble)


def test_a_cause_may_have_two_parents() -> None:
    causes = Causes()
    both, one, other = map(Keyword, ("BOTH", "ONE", "OTHER"))
    causes.define(both, (one, other))
    assert causes.answers(one, both) and causes.answers(other, both)


def test_a_new_definition_replaces_the_parents() -> None:
    causes = Causes()
    child, old, new = map(Keyword, ("CHILD", "OLD", "NEW"))
    causes.define(child, (old,))
    assert causes.answers(old, child)
    causes.define(child, (new,))
    assert not causes.answers(old, child)


@pytest.mark.parametrize("parents", [("A",), ("B",), ("C",)])
def test_the_hierarchy_has_no_circles(parents: tuple[str, ...]) -> None:
    causes = Causes()
    causes.define(Keyword("B"), (Keyword("A"),))
    causes.define(Keyword("C"), (Keyword("B"),))
    with pytest.raises(Failure) as caught:
        causes.define(Keyword("A"), tuple(map(Keyword, parents)))
    assert str(caught.value.cause) == ":CONTROL-ERROR"


# --- jumps over borders ------------------------------------------------------------------

JUMPS = {
    "a RETURN-FROM over a lambda": "(block out (mapc (lambda (x) {body}) '(1 2)))|(return-from out :left)",
    "a THROW": "(catch 'out {body})|(throw 'out :left)",
    "a GO": "(let (r) (tagbody (setq r {body}) out (setq r :left)) r)|(go out)",
    "ABORT of the form": "{body}|(abort :left)",
    "ABORT of an outer form": "(with-recovery-procedures ((:b (abort :left))) {body})|(fail :b)",
}


@pytest.mark.parametrize("jump", JUMPS)
def test_a_procedure_may_leave_by(jump: str) -> None:
    """Cleanups on the way run, innermost first and once; the form's own state is set back."""
    around, leave = JUMPS[jump].split("|")
    body = f"""(with-recovery-procedures ((:a {leave}))
                 (with-cleanup-procedure (princ 1)
                   (unwind-protect (with-cleanup-procedure (princ 0) (fail :a)) (princ :u))))"""
    text = f"""(let ((value {around.format(body=body)})) (print value))
               (print (with-recovery-procedures ((:a (abort :again))) (fail :a)))"""
    assert lines_of(text) == ["0U1", ":LEFT", ":AGAIN"]


def test_multiple_values_pass_through_everything() -> None:
    text = """
    (print (multiple-value-list
      (block out
        (with-recovery-procedures ((:a (return-from out (values 1 2 3))))
          (with-cleanup-procedure nil (unwind-protect (fail :a) 9))))))
    (print (multiple-value-list
      (with-recovery-procedures ((:a (values 4 5))) (with-cleanup-procedure nil (fail :a)))))
    (print (multiple-value-list (with-recovery-procedures () (values 6 7))))
    """
    assert lines_of(text) == ["(1 2 3)", "(4)", "(6 7)"]


def test_special_bindings_are_undone_only_when_the_procedure_jumps() -> None:
    text = """
    (defvar *where* :outside)
    (print (with-recovery-procedures ((:a (print *where*) (abort *where*)))
             (let ((*where* :inside)) (fail :a))))
    (print *where*)
    """
    assert lines_of(text) == [":INSIDE", ":INSIDE", ":OUTSIDE"]


def test_a_retry_that_is_kept_beyond_its_form_is_a_control_error() -> None:
    text = """
    (defvar *again* nil)
    (with-recovery-procedures ((:a (setq *again* (lambda () (retry))) (abort))) (fail :a))
    (funcall *again*)
    """
    assert str(run(text).failure.cause) == ":CONTROL-ERROR"


def test_retries_are_counted_for_each_entrance_of_a_recursive_form() -> None:
    text = """
    (defun deep (n)
      (with-recovery-procedures ((:a (princ n) (if (= n 0) (abort) (deep (- n 1))) (abort)))
        (fail :a)))
    (deep 3)
    """
    assert lines_of(text) == ["3210"]


# --- cleanup -------------------------------------------------------------------------------


def test_a_failure_of_a_cleanup_is_told_and_the_first_one_goes_on() -> None:
    came = run("(with-cleanup-procedure (fail :second) (fail :first))")
    assert str(came.failure.cause) == ":FIRST"
    assert came.trace == [
        "Failure :FIRST, no recovery available.",
        "Failure :SECOND, no recovery available.",
        "Aborted",
    ]


def test_procedures_inside_the_body_do_not_see_what_cleanup_does() -> None:
    text = """
    (with-recovery-procedures ((:b (princ :outer) (abort)))
      (with-cleanup-procedure (fail :b)
        (with-recovery-procedures ((:b (princ :inner) (abort))) (fail :a))))
    """
    assert lines_of(text) == ["OUTER"]


def test_what_a_cleanup_does_cannot_keep_a_run_that_is_to_end(interp: Any) -> None:
    interp.primitive(lambda: interp.interrupt("enough", 130), name="enough", signature="(enough)")
    text = """
    (with-recovery-procedures ((:in-cleanup :retries :infinite (retry)))
      (with-cleanup-procedure (fail :in-cleanup) (enough) (loop)))
    """
    with pytest.raises(Stop) as caught:
        interp.eval(text)
    assert caught.value.code == 130
    assert interp.eval("(loop repeat 5000 count t)") == 5000


def test_no_form_is_left_active_after_a_run(interp: Any) -> None:
    for text in ("(with-recovery-procedures ((:a (fail :b))) (fail :a))", "(catch 'x (car 5))", "(fail :c)"):
        with pytest.raises(Failure):
            interp.eval(text)
        assert interp.dynamic.forms is None
        assert interp.dynamic.answering == [] and interp.dynamic.catches == []


# --- through Python and back -----------------------------------------------------------------


@pytest.fixture
def back(interp: Any) -> Any:
    """An interpreter in which (back n) calls (down n) from Python."""
    interp.primitive(lambda n: interp.call("down", n), name="back", signature="(back n)")
    return interp


def test_a_plan_may_call_python_and_python_the_plan_very_deep(back: Any) -> None:
    back.eval("(defun down (n) (if (= n 0) 0 (+ 1 (back (- n 1)))))")
    assert back.call("down", 5000) == 5000


@pytest.mark.slow
def test_recursion_without_end_through_python_exhausts_the_stack(back: Any) -> None:
    back.eval("(defun down (n) (with-cleanup-procedure nil (back n)))")
    assert back.eval("(with-recovery-procedures ((:stack-exhausted (abort 7))) (down 1))") == 7
    with pytest.raises(Failure) as caught:
        back.call("down", 1)
    assert str(caught.value.cause) == ":STACK-EXHAUSTED"
