"""Steps: what counts as an action, what passes through constructs, and what their conditions may do."""

from __future__ import annotations

import pytest

from eslang import EslError
from eslang.tools.expectations import failure_text
from support import lines_of, run

COUNTED = "(defvar *asked* 0) (defun look () (incf *asked*) t)"
NOW = "(defun now () (/ (get-internal-real-time) internal-time-units-per-second))"


def said(text: str, seed: int = 0) -> str:
    """What TEXT prints, in one line."""
    return " ".join(line.strip() for line in lines_of(NOW + text, seed=seed))


# --- actions -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("definitions", "steps", "times"),
    [
        ("", "1 2 3", 4),
        ("(defaction turn () 1)", "(turn) (turn)", 3),
        ("(defaction turn () 1) (defstep both () (turn) (turn))", "(both) 1", 4),
        ("(defaction turn () 1) (defun turn () 2)", "(turn)", 2),
        ("(defun turn () 1) (defaction turn () 2)", "(turn)", 2),
        ("", "(atomic 1 2 3)", 2),
        ("", "(scs:do 1 (scs:do 2)) (do-any 3)", 4),
        ("(defaction turn () 1)", "(flet ((turn () 2)) (turn))", 2),
    ],
)
def test_lisp_is_asked_once_before_and_once_after_each_action(
    definitions: str, steps: str, times: int
) -> None:
    assert said(f"{COUNTED} {definitions} (scs:do :while (look) {steps}) (print *asked*)") == str(times)


def test_a_local_function_is_not_the_action_of_that_name() -> None:
    text = "(defaction grip () :action) (print (flet ((grip () :local)) (scs:do (grip))))"
    assert said(text) == ":LOCAL"


def test_a_local_function_may_have_the_name_of_a_construct() -> None:
    assert said("(print (flet ((do-any (x) (list :mine x))) (scs:do (do-any 1))))") == "(:MINE 1)"


def test_an_action_can_be_called_as_a_function() -> None:
    text = """(defaction twice (x) (* 2 x))
    (print (list (funcall 'twice 1) (apply #'twice '(2)) (mapcar #'twice '(3))))"""
    assert said(text) == "(2 4 (6))"


def test_an_action_may_define_how_a_place_is_set() -> None:
    text = """(defvar *speed* 0) (defaction (setf speed) (new) (setq *speed* new))
    (setf (speed) 3) (print *speed*)"""
    assert said(text) == "3"


def test_actions_and_steps_are_blocks_of_their_names() -> None:
    text = """(defaction grip (x) (if x (return-from grip :early)) :late)
    (defstep carry (x) (if x (return-from carry :early)) :late)
    (print (list (grip t) (grip nil) (carry t) (carry nil)))"""
    assert said(text) == "(:EARLY :LATE :EARLY :LATE)"


def test_documentation_and_declarations_stand_before_the_steps() -> None:
    text = """(defstep wait-here (x) "Do nothing." :when (numberp x) (list x))
    (defaction rest-here (x) "Rest." (declare (ignore x)) :rested)
    (print (list (wait-here 1) (wait-here :x) (rest-here 1)))
    (print (list (documentation 'wait-here 'function) (documentation 'rest-here 'function)))"""
    assert said(text) == '((1) :DEACTIVATED :RESTED) ("Do nothing." "Rest.")'


def test_a_masked_construct_leaves_nothing_that_holds_interrupts_off() -> None:
    text = """(catch 'out (atomic (throw 'out 1)))
    (let ((task (current-task))) (spawn (interrupt-task task (lambda () (print :heard)))) (sleep 1))"""
    assert said(text) == ":HEARD"


# --- values and jumps ------------------------------------------------------------------


@pytest.mark.parametrize(
    "form",
    [
        "(scs:do 1 (values 1 2))",
        "(scs:do* (values 1 2))",
        "(scs:do :while t (values 1 2))",
        "(atomic (values 1 2))",
        "(do-any (values 1 2))",
        "(do-first (t 1 (values 1 2)))",
        "(do-best (t 1 (values 1 2)))",
        "(scs:do (do-first (t (do-any (values 1 2)))))",
        "(both)",
        "(act)",
    ],
)
def test_all_values_of_the_last_step_come_back(form: str) -> None:
    text = (
        f"(defstep both () (values 1 2)) (defaction act () (values 1 2)) (print (multiple-value-list {form}))"
    )
    assert said(text) == "(1 2)"


@pytest.mark.parametrize(
    "form",
    [
        "(scs:do 1 (return-from out :left) 2)",
        "(repeat (return-from out :left))",
        "(do-any (return-from out :left) (return-from out :left))",
        "(do-first :while t (t (repeat* (return-from out :left))))",
        "(do*-best (t 1 (return-from out :left)))",
        "(with-cycle (1) (return-from out :left))",
        "(atomic (return-from out :left))",
        "(catch 'k (do-first (t (throw 'k :left))))",
        "(tagbody (repeat (go end)) end (return-from out :left))",
        "(do-first ((return-from out :left) 1))",
    ],
)
def test_a_jump_leads_out_of_a_construct(form: str) -> None:
    assert said(f"(print (block out {form}))") == ":LEFT"


def test_a_jump_leaves_no_condition_behind() -> None:
    text = COUNTED + "(block out (scs:do :while (look) (return-from out 1))) (scs:do 1 2 3) (print *asked*)"
    assert said(text) == "1"


@pytest.mark.parametrize("form", ["(return-from out 1)", "(throw 'out 1)"])
def test_no_jump_leads_out_of_a_branch(form: str) -> None:
    came = run(f"(block out (catch 'out (do-all {form} (repeat (sleep 1)))))")
    assert failure_text(came.failure).startswith(":CONTROL-ERROR")


# --- conditions ------------------------------------------------------------------------


def test_a_failure_of_a_condition_is_the_constructs_own_and_not_that_of_its_steps() -> None:
    text = """(defvar *asked* 0) (defun look () (if (= (incf *asked*) 2) (fail :blind) t))
    (print (with-recovery-procedures ((:blind (abort :outside)))
             (scs:do :while (look) (scs:do* (do-any (scs:do 1 2) (scs:do 3 4))))))"""
    assert said(text) == ":OUTSIDE"


def test_a_failing_condition_is_asked_again_on_retry() -> None:
    text = """(defvar *asked* 0) (defun look () (if (= (incf *asked*) 2) (fail :blind) t))
    (with-recovery-procedures ((:blind (retry))) (scs:do :while (look) (princ :a) (princ :b)))"""
    assert said(text) == "AAB"


def test_a_recovery_procedure_may_answer_for_a_condition() -> None:
    text = """(defvar *asked* 0) (defun look () (if (= (incf *asked*) 2) (fail :blind) t))
    (print (with-recovery-procedures ((:blind nil)) (scs:do :while (look) (princ :a) (princ :b))))"""
    assert said(text) == "A :DEACTIVATED"


def test_a_condition_may_wait() -> None:
    text = "(print (scs:do :while (progn (sleep 1) t) (princ :a) (princ :b))) (print (now))"
    assert said(text) == "AB :B 3"


def test_a_condition_may_be_a_construct() -> None:
    text = """(assert '(going))
    (print (scs:do :while (do-any (fail :x) (do-first ((going) t) (t nil)))
             (retract '(going)) (print :never)))"""
    assert said(text) == ":DEACTIVATED"


def test_a_condition_may_change_the_facts_that_it_reads() -> None:
    text = """(assert '(count 0))
    (defun bump ()
      (let ((n (cdr (caar (db-query '(count ?n))))))
        (update '(count ?_) `(count ,(1+ n)))
        (< n 3)))
    (print (repeat :while (bump) 1)) (print (db-query '(count ?n)))"""
    assert said(text) == ":DEACTIVATED (((?N . 4)))"


def test_a_condition_under_a_backquote_is_computed_at_the_entrance() -> None:
    text = """(assert '(at cup shelf))
    (let ((thing 'cup))
      (print (scs:do :while `(at ,thing ?_) (setq thing 'pen) (assert '(at cup table)) (princ :on)
                     (retract '(at cup ?_)) (print :never))))"""
    assert said(text) == "ON :DEACTIVATED"


def test_a_fact_that_is_away_within_one_action_has_not_been_away() -> None:
    text = """(assert '(going))
    (print (scs:do :while (going) (atomic (retract '(going)) (assert '(going))) :done))"""
    assert said(text) == ":DONE"


def test_a_change_of_ones_own_is_heard_when_the_same_step_waits() -> None:
    text = """(assert '(going))
    (print (scs:do :while (going) (progn (retract '(going)) (sleep 5) (print :never)))) (print (now))"""
    assert said(text) == ":DEACTIVATED 0"


def test_of_levels_that_end_at_once_the_outermost_is_left() -> None:
    text = """(assert '(a)) (assert '(b)) (spawn (progn (sleep 1) (retract '(b)) (retract '(a))))
    (print (scs:do :while (a) (print (scs:do :while (b) (sleep 3))) (print :never)))"""
    assert said(text) == ":DEACTIVATED"


def test_nothing_binds_variables_where_the_condition_is_false() -> None:
    came = run("(scs:do :unless (broken ?what) (print #?what))")
    assert failure_text(came.failure) == ":UNBOUND-VARIABLE ?WHAT"


# --- nesting -----------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("modifiers", ["", ":while (going)", ":when (>= n 0) :while (going)"])
def test_steps_call_themselves_a_thousand_deep(modifiers: str) -> None:
    text = f"""(assert '(going)) (defstep down (n) {modifiers} (if (> n 0) (down (1- n)) :bottom))
    (print (down 1000))"""
    assert said(text) == ":BOTTOM"


@pytest.mark.slow
def test_a_thousand_levels_are_left_at_once() -> None:
    text = """(assert '(going))
    (defstep down (n) :while (going) (if (> n 0) (down (1- n)) (retract '(going))) (print :never))
    (print (down 1000))"""
    assert said(text) == ":DEACTIVATED"


@pytest.mark.slow
def test_a_step_that_calls_itself_without_end_exhausts_the_stack() -> None:
    text = """(defstep down (n) (scs:do (down (1+ n))))
    (print (with-recovery-procedures ((:stack-exhausted (abort :exhausted))) (down 0)))"""
    assert said(text) == ":EXHAUSTED"


# --- names and shapes ----------------------------------------------------------------------


def test_do_is_common_lisps_for_plans_and_that_of_scs_in_its_own_package() -> None:
    assert said("(do ((i 0 (1+ i))) ((= i 3)) (princ i)) (do* ((i 5 (1+ i))) ((= i 7)) (princ i))") == "01256"
    assert said("(in-package :scs-user) (print (do :unless nil 1 (do* 2)))") == "2"


@pytest.mark.parametrize(
    "form",
    [
        "(scs:do :while)",
        "(scs:do :done 1)",
        "(do-all :whenever t 1)",
        "(scs:do 1 :while nil 2)",
        "(scs:do :while :until t 1)",
        "(atomic :while nil 1)",
        "(defaction a () :when t 1)",
        "(do-first (t :when nil 1))",
        "(do-first t 1)",
        "(do-first ())",
        "(do-first (t . 1))",
        "(do-first :learn t (t 1))",
        "(do-best (t))",
        "(do-best :learn)",
        "(with-cycle 10 1)",
        "(with-cycle () 1)",
        "(with-cycle (1 2) 1)",
    ],
)
def test_a_construct_that_is_not_of_its_shape_is_refused(form: str) -> None:
    came = run(form)
    assert came.error.diagnostic.name == "malformed-step"
    assert came.error.diagnostic.labels[0].span.line == 1


@pytest.mark.parametrize(
    "form", ["(defaction grip)", "(defstep)", "(defaction 3 () 1)", "(defstep s (x x) 1)", "(do-any . 5)"]
)
def test_what_is_wrong_with_any_definition_is_wrong_here(form: str) -> None:
    assert isinstance(run(form).error, EslError)


@pytest.mark.parametrize("form", ["(scs:do :done)", "(scs:do :when t :done)", "(do-any ':done ':done)"])
def test_a_keyword_that_no_condition_can_follow_is_a_value(form: str) -> None:
    assert said(f"(print {form})") == ":DONE"


def test_what_a_name_was_is_forgotten_when_it_is_defined_anew() -> None:
    text = (
        COUNTED
        + """(defaction grip () 1) (defun grip () (scs:do 1 2)) (scs:do :while (look) (grip))
    (print *asked*)"""
    )
    assert said(text) == "4"
