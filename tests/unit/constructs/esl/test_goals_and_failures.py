"""Goals (ESL §3) where they meet failures."""

from __future__ import annotations

from support import lines_of


def test_a_recovery_procedure_reads_the_bindings_of_the_form_it_stands_in() -> None:
    text = """
    (defvar *done* nil)
    (defun outer (x) (and (= x 1) *done*))
    (defun inner (x) (= x 0))
    (to-achieve (outer ?x)
      (t (with-recovery-procedures ((:slipped (print #?x) (setq *done* t) (abort)))
           (achieve (inner 5)))))
    (to-achieve (inner ?x) (t (fail :slipped)))
    (achieve (outer 1))
    """
    assert lines_of(text) == ["1"]
