"""Recovery clauses: their two forms, what is wrong with others, and where that is said."""

from __future__ import annotations

import pytest

from eslang import EslError
from support import lines_of, run

MISTAKES = {
    "(with-recovery-procedures 5 1)": (1, 27),
    "(with-recovery-procedures (5) 1)": (1, 28),
    "(with-recovery-procedures ((5 1)) 1)": (1, 29),
    '(with-recovery-procedures (("a" 1)) 1)': (1, 29),
    "(with-recovery-procedures ((nil 1)) 1)": (1, 29),
    "(with-recovery-procedures (('a 1)) 1)": (1, 29),
    "(with-recovery-procedures (((:a 5) 1)) 1)": (1, 33),
    "(with-recovery-procedures (((:a (b)) 1)) 1)": (1, 33),
    "(with-recovery-procedures (((:a &key b) 1)) 1)": (1, 33),
    "(with-recovery-procedures ((:a :retries)) 1)": (1, 32),
    "(with-recovery-procedures (:a :retries) 1)": (1, 31),
    "(with-recovery-procedures ((:a :retries :often 1)) 1)": (1, 41),
    "(with-recovery-procedures ((:a :retries -1 1)) 1)": (1, 41),
    "(with-recovery-procedures ((:a :retries 1.5 1)) 1)": (1, 41),
    "(with-recovery-procedures ((:a :retrys 1 1)) 1)": (1, 32),
    "(with-recovery-procedures\n  ((:a 1)\n   (((:b)) 1)) 1)": (3, 5),
}


@pytest.mark.parametrize("text", MISTAKES)
def test_what_is_wrong_is_said_where_it_is_wrong(text: str) -> None:
    error = run(text).error
    assert isinstance(error, EslError)
    span = error.diagnostic.labels[0].span
    assert (span.line, span.column) == MISTAKES[text]


VALUES = {
    "((:a 1))": "1",
    "(:a 1)": "1",
    "((:a))": "NIL",
    "((:a :idle))": ":IDLE",
    "((:a :retries 1))": "NIL",
    "((:a :retries 1 2))": "2",
    "((:a :retries :infinite 2))": "2",
    "((:a :retries (+ 1 1) 3))": "3",
    "(((:a) 1))": "1",
    "(((:a x) x))": "10",
    "(((:a x y) (list x y)))": "(10 20)",
    "(((:a x y z) (list x y z)))": "(10 20 NIL)",
    "(((:a . all) all))": "(10 20)",
    "(((:a x . more) (list x more)))": "(10 (20))",
    "(((:a x &rest more) (list x more)))": "(10 (20))",
    "(((:a &optional x) x))": "10",
    "((:b 1) (:a 2))": "2",
    "((:general-failure (failure-arguments)))": "(10 20)",
    "(:general-failure (failure-cause))": ":A",
}


@pytest.mark.parametrize("clauses", VALUES)
def test_a_clause_answers_with_its_arguments_bound(clauses: str) -> None:
    assert lines_of(f"(print (with-recovery-procedures {clauses} (fail :a 10 20)))") == [VALUES[clauses]]


def test_a_clause_sees_the_lexical_variables_around_its_form() -> None:
    text = """
    (defun repaired (part)
      (let ((tries 0))
        (with-recovery-procedures (((:worn tool) :retries 2 (incf tries) (retry)))
          (if (< tries 2) (fail :worn 'drill) (list part tries)))))
    (print (repaired 'arm))
    """
    assert lines_of(text) == ["(ARM 2)"]


def test_a_macro_may_make_clauses() -> None:
    text = """
    (defmacro persistently ((cause times) &body body)
      `(with-recovery-procedures ((,cause :retries ,times (retry))) ,@body))
    (let ((n 0)) (print (persistently (:flaky 5) (if (< (incf n) 4) (fail :flaky) n))))
    """
    assert lines_of(text) == ["4"]


@pytest.mark.parametrize(
    "form", ["(retry)", "(abort 1)", "(funcall (lambda () (retry)))", "(mapc (lambda (x) (abort x)) '(1))"]
)
def test_a_jump_belongs_to_the_clause_around_it_however_deep_it_stands(form: str) -> None:
    text = f"(let ((n 0)) (print (with-recovery-procedures ((:a {form})) (if (= (incf n) 1) (fail :a) 1))))"
    assert lines_of(text) == ["1"]
