"""Functions that call a function may be nested as deep as any others: none goes through the C stack."""

from __future__ import annotations

import pytest
from forms import value_of

DEPTH = 30_000
BODIES = {
    "mapcar": "(car (mapcar #'deep (list (1- n))))",
    "mapcar of two lists": "(car (mapcar (lambda (a b) (deep (* a b))) (list (1- n)) '(1)))",
    "mapc": "(progn (mapc #'deep (list (1- n))) 0)",
    "mapcan": "(progn (mapcan (lambda (x) (list (deep x))) (list (1- n))) 0)",
    "maplist": "(car (maplist (lambda (x) (deep (car x))) (list (1- n))))",
    "map": "(car (map 'list #'deep (list (1- n))))",
    "map-into": "(car (map-into (list 0) #'deep (list (1- n))))",
    "every": "(progn (every #'deep (list (1- n))) 0)",
    "some of two lists": "(some (lambda (a b) (deep (* a b))) (list (1- n)) '(1))",
    "reduce": "(reduce (lambda (a b) (deep (* a b))) (list (1- n) 1))",
    "find-if": "(progn (find-if #'deep (vector (1- n))) 0)",
    "find with a key": "(progn (find 7 (list (1- n)) :key #'deep) 0)",
    "position with a test": "(position 0 (list (1- n)) :test (lambda (a b) (deep (+ a b))))",
    "count-if": "(progn (count-if #'deep (list (1- n))) 0)",
    "remove-if": "(progn (remove-if #'deep (list (1- n))) 0)",
    "delete-if": "(progn (delete-if #'deep (list (1- n))) 0)",
    "substitute-if": "(progn (substitute-if 0 #'deep (list (1- n))) 0)",
    "remove-duplicates": "(progn (remove-duplicates (list (1- n) 0) :test (lambda (a b) (deep (+ a b)))) 0)",
    "search": "(progn (search (list (1- n)) '(0) :test (lambda (a b) (deep (+ a b)))) 0)",
    "sort": "(progn (sort (list (1- n) 0) (lambda (a b) (deep (+ a b)))) 0)",
    "merge": "(progn (merge 'list (list (1- n)) '(0) (lambda (a b) (deep (+ a b)))) 0)",
    "member-if": "(progn (member-if #'deep (list (1- n))) 0)",
    "assoc with a key": "(progn (assoc 7 (list (cons (1- n) 0)) :key #'deep) 0)",
    "union": "(progn (union (list (1- n)) '(0) :test (lambda (a b) (deep (+ a b)))) 0)",
    "subst-if": "(progn (subst-if 0 #'deep (1- n)) 0)",
    "tree-equal": "(progn (tree-equal (1- n) 0 :test (lambda (a b) (deep (+ a b)))) 0)",
    "sublis": "(progn (sublis '((1 . 2)) (1- n) :key #'deep) 0)",
    "maphash": "(let ((h (make-hash-table)))"
    " (setf (gethash n h) 1) (maphash (lambda (k v) (deep (- k v))) h) 0)",
    "typep": "(progn (typep (1- n) '(or (satisfies deep) string)) 0)",
}


@pytest.mark.slow
@pytest.mark.parametrize("name", BODIES)
def test_depth(name: str) -> None:
    defined = f"(defun deep (n) (if (<= n 0) 0 {BODIES[name]}))"
    assert value_of(f"{defined} (deep {DEPTH})") == "0"
