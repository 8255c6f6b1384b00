"""Property locks in the language: what may stand where, and what comes of mistakes (ARM §4)."""

from __future__ import annotations

import pytest

from eslang import EslError, Failure
from support import lines_of, run

WORLD = """
(defproperty lamp (where state))
(to-achieve (lamp ?where ?state)
  (t (sleep 1) (assert '(lamp #?where #?state))))
(defun now () (/ (get-internal-real-time) internal-time-units-per-second))
"""


def test_one_property_need_not_be_in_a_list() -> None:
    assert lines_of(WORLD + "(print (with-maintained-properties (lamp hall :on) (now)))") == ["1"]


def test_no_property_is_nothing_to_maintain() -> None:
    assert lines_of(WORLD + "(print (with-maintained-properties () (now)))") == ["0"]


def test_a_property_may_be_computed() -> None:
    text = """(let ((where 'hall))
      (with-maintained-properties (`(lamp ,where :on) '(lamp door :on)) (print (db-query '(lamp ?x ?y)))))"""
    assert lines_of(WORLD + text) == ["(((?X . HALL) (?Y . :ON)) ((?X . DOOR) (?Y . :ON)))"]


def test_a_property_may_speak_of_bindings() -> None:
    text = """(assert '(dark hall))
      (with-query-bindings '(dark ?where)
        (with-maintained-properties ((lamp #?where :on)) (print (db-query '(lamp ?x ?y)))))"""
    assert lines_of(WORLD + text) == ["(((?X . HALL) (?Y . :ON)))"]


def test_all_values_of_the_body_come_back() -> None:
    text = "(print (multiple-value-list (with-maintained-properties ((lamp hall :on)) (values 1 2))))"
    assert lines_of(WORLD + text) == ["(1 2)"]


def test_the_body_may_return_from_around() -> None:
    text = """(print (block out (with-maintained-properties ((lamp hall :on)) (return-from out :left))))
              (print (with-maintained-properties ((lamp hall :off)) :free))"""
    assert lines_of(WORLD + text) == [":LEFT", ":FREE"]


@pytest.mark.parametrize(
    "wrong",
    [
        "lamp",
        "((lamp))",
        "(5)",
        "(lamp)",
        "((5 6))",
        "(not (lamp hall :on))",
        "((or (lamp hall :on) (lamp hall :off)))",
    ],
)
def test_what_is_written_as_no_property_is_refused(wrong: str) -> None:
    came = run(f"(defun f () (with-maintained-properties {wrong} 1))")
    assert isinstance(came.error, EslError)
    assert "is no property" in str(came.error)


@pytest.mark.parametrize("wrong", ["(lamp ?where :on)", "(lamp (room ?x) :on)", "'(not (lamp hall :on))"])
def test_a_property_of_no_known_thing_is_no_property(wrong: str) -> None:
    came = run(WORLD + f"(with-maintained-properties ({wrong}) 1)")
    assert isinstance(came.failure, Failure)
    assert str(came.failure).startswith("failure :TYPE-ERROR")


def test_what_is_no_property_has_no_recovery_to_wait_for() -> None:
    came = run("(wait-for-recovery 'lamp)")
    assert str(came.failure) == "failure :TYPE-ERROR LAMP PROPERTY WAIT-FOR-RECOVERY"


def test_any_value_will_do_where_it_is_a_variable() -> None:
    text = """(assert '(lamp hall :dim))
      (task-net (a (with-maintained-properties ((lamp hall ?any)) (sleep 5) (print :a)))
                (b (sleep 1) (with-maintained-properties ((lamp hall ?x)) (print :b)))
                (c (sleep 2) (with-maintained-properties ((lamp hall :on)) (print :c))))"""
    assert lines_of(WORLD + text) == [":B", ":C", ":A"]


def test_values_may_be_lists_and_strings() -> None:
    text = """(defproperty at (thing place))
      (defun try (place) (with-recovery-procedures ((:property-lock-unavailable (abort :no)))
                           (with-maintained-properties (`(at robot ,place)) :yes)))
      (assert '(at robot (room 3 "west")))
      (with-maintained-properties ((at robot (room 3 "west")))
        (print (list (try '(room 3 "west")) (try '(room 3 ?_)) (try '(room 4 "west")) (try 5))))"""
    assert lines_of(text) == ["(:YES :YES :NO :NO)"]


def test_who_waits_in_vain_for_an_owner_is_told_of_by_name() -> None:
    text = """(to-achieve (lamp ?where ?state) (t (wait-for-events (make-event 'never))))
      (task-net (owner (with-maintained-properties ((lamp hall :on)) 1))
                (second (yield) (with-maintained-properties ((lamp hall :on)) 2)))"""
    came = run(WORLD + text)
    assert "the achievement of (lamp hall :on)" in str([str(each) for each in came.failure.arguments])


def test_methods_that_need_one_another_are_a_deadlock_though_others_run() -> None:
    text = """(defproperty a) (defproperty b)
      (to-achieve (a ?x) (t (sleep 1) (with-maintained-properties ((b 1)) (assert '(a #?x)))))
      (to-achieve (b ?x) (t (sleep 2) (with-maintained-properties ((a 1)) (assert '(b #?x)))))
      (defun try-a () (with-recovery-procedures (((:condition-not-achieved what cause) (abort cause)))
                        (with-maintained-properties ((a 1)) 1)))
      (defun try-b () (with-recovery-procedures (((:condition-not-achieved what cause) (abort cause)))
                        (with-maintained-properties ((b 1)) 1)))
      (print (multiple-value-list (task-net (one (try-a)) (two (try-b)) (other (sleep 99) 3))))"""
    assert lines_of(text) == ["(:CONDITION-NOT-ACHIEVED :DEADLOCK 3)"]


def test_a_method_that_needs_its_own_property_fails() -> None:
    text = """(to-achieve (lamp ?where ?state)
        (t (with-maintained-properties ((lamp #?where #?state)) 1)))
      (with-maintained-properties ((lamp hall :on)) 1)"""
    came = run(WORLD + text)
    assert [str(each) for each in came.failure.arguments][1] == ":CONTROL-ERROR"


def test_the_recovery_function_is_the_global_one() -> None:
    text = """(defun mend (property) (print :mend) (assert property))
      (setq *recovery-function* 'mend)
      (let ((*recovery-function* (lambda (property) (print :never))))
        (spawn (progn (sleep 2) (assert '(lamp hall :off))))
        (with-automatic-recoveries (with-maintained-properties ((lamp hall :on)) (sleep 5))))"""
    assert lines_of(WORLD + text) == [":MEND"]


def test_facts_from_python_violate_a_property_as_well() -> None:
    from eslang import Interpreter

    with Interpreter(clock="virtual") as agent:
        agent.eval(WORLD)
        agent.eval(
            """(defun keep () (with-recovery-procedures ((:maintained-property-violation (abort :violated)))
                 (with-maintained-properties ((lamp hall :on)) (sleep 9) :kept)))"""
        )
        agent.primitive(name="spoil", signature="(spoil)")(
            lambda: agent.eval("(assert '(lamp hall :off))") and None
        )
        assert str(agent.eval("(progn (spawn (progn (sleep 3) (spoil))) (keep))")) == ":VIOLATED"


def test_wait_for_recovery_returns_at_once_if_nothing_was_violated() -> None:
    text = "(print (with-maintained-properties ((lamp hall :on)) (wait-for-recovery '(lamp hall :on))))"
    assert lines_of(WORLD + text) == ["NIL"]


def test_the_locks_of_a_run_that_was_stopped_are_free() -> None:
    from eslang import Interpreter
    from eslang.base.control import Stop

    with Interpreter(clock="virtual") as agent:
        agent.eval(WORLD)
        with pytest.raises(Stop):
            agent.eval("(with-maintained-properties ((lamp hall :on)) (quit 3))")
        assert agent.locks is not None
        assert agent.locks.holdings() == []
        assert agent.eval("(with-maintained-properties ((lamp hall :off)) 5)") == 5


def test_a_property_that_rests_on_a_variable_is_maintained_as_well() -> None:
    text = """(defvar *limit* 10)
      (defrelation load)
      (defrule (safe ?where :yes) (load ?where ?amount) (< ?amount *limit*))
      (assert '(load hall 5))
      (task-net (a (with-recovery-procedures (((:maintained-property-violation what) (abort (print what))))
                     (with-maintained-properties ((safe hall :yes)) (sleep 60) (print :never))))
                (b (sleep 2) (setq *limit* 3)))"""
    assert lines_of(text) == ["(SAFE HALL :YES)"]
