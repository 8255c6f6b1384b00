"""DEFTYPE and WITH-HASH-TABLE-ITERATOR."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ("(deftype t-digit () '(integer 0 9))", "T-DIGIT"),
        ("(mapcar (lambda (x) (typep x 't-digit)) '(5 10 a))", "(T NIL NIL)"),
        ("(typecase 4 (t-digit :digit) (t :other))", ":DIGIT"),
        ("(deftype t-range (low &optional high) `(integer ,low ,high))", "T-RANGE"),
        ("(list (typep 5 '(t-range 3)) (typep 5 '(t-range 6)) (typep 5 '(t-range 1 4)))", "(T NIL NIL)"),
        ("(deftype t-triple () '(vector t 3))", "T-TRIPLE"),
        ("(coerce '(1 2 3) 't-triple)", "#(1 2 3)"),
        ("(concatenate 't-triple '(1) '(2))", "failure :ERROR"),
        ("(deftype integer () 'string)", "failure :ERROR"),
        ("(typep 1 't-unknown)", "failure :ERROR"),
    ],
)
def test_deftype(form: str, value: str) -> None:
    defined = "(deftype t-digit () '(integer 0 9)) (deftype t-triple () '(vector t 3))"
    ranged = "(deftype t-range (low &optional high) `(integer ,low ,high))"
    assert value_of(f"{defined} {ranged} {form}") == value


def test_the_body_of_deftype_is_a_block_of_its_name() -> None:
    assert value_of("(deftype t-early () (return-from t-early 'string)) (typep \"a\" 't-early)") == "T"


def test_a_table_is_walked_entry_by_entry() -> None:
    text = """
      (let ((table (make-hash-table)) (seen nil))
        (setf (gethash :a table) 1
              (gethash :b table) nil)
        (with-hash-table-iterator (next table)
          (loop (multiple-value-bind (more key value) (next)
                  (unless more (return))
                  (push (list key value) seen))))
        (nreverse seen))"""
    assert value_of(text) == "((:A 1) (:B NIL))"
