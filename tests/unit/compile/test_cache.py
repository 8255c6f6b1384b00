"""Compiled code on disk: right when warm, harmless when damaged, never stale."""

from __future__ import annotations

import os
from collections.abc import Iterator
from io import StringIO
from pathlib import Path

import pytest

from eslang import EslError, Interpreter
from eslang.base.words import SPECIAL_FORMS
from eslang.compile import cache
from support import run_python


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A cache of these tests' own, which holds the library already."""
    cache_folder = tmp_path_factory.mktemp("cache")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ESLANG_CACHE", str(cache_folder))
        Interpreter(clock="virtual")
        yield cache_folder


def said(*paths: Path) -> str:
    """What a new interpreter prints on loading PATHS."""
    output = StringIO()
    with Interpreter(clock="virtual", output=output) as interp:
        for path in paths:
            interp.load(path)
    return output.getvalue()


def plan(tmp_path: Path, text: str, name: str = "plan.esl") -> Path:
    """A file that holds TEXT."""
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    return path


EVERY_CONSTANT = """
(defmacro twice (form) (let ((value (gensym))) `(let ((,value ,form)) (+ ,value ,value))))
(defstruct point x (y 2))
(defun both () (values 1 :two))
(defun through () (both))
(print (list 'a :b "c" #\\d 1/2 1.5 '(1 . 2) #(1 2) '#:g '|odd name|))
(print (twice 4))
(print (make-point :x 1))
(print (multiple-value-list (through)))
(print (funcall (lambda (&key (depth 3)) depth) :depth 7))
(print (gensym))
"""


def test_a_kept_text_does_what_it_did_when_it_was_compiled(folder: Path, tmp_path: Path) -> None:
    path = plan(tmp_path, EVERY_CONSTANT)
    before = len(list(folder.iterdir()))
    cold = said(path)
    assert len(list(folder.iterdir())) == before + 1
    assert said(path) == cold
    assert '(A :B "c" #\\d 1/2 1.5 (1 . 2) #(1 2) #:G |odd name|)' in cold


def test_a_kept_text_is_run_without_the_compiler(folder: Path, tmp_path: Path) -> None:
    path = plan(tmp_path, "(defun main () (prin1 :warm) (princ #\\Space))")
    said(path)
    loaded = run_python(
        "import sys; from eslang import Interpreter; i = Interpreter(); "
        f"i.load({str(path)!r}); i.call('main'); "
        "late = ('lark', 'ast', 'eslang.compile.emit', 'eslang.reader.reader'); "
        "print([module for module in late if module in sys.modules])"
    )
    assert loaded == ":WARM []"


INTROSPECTION = """
(print (list (special-operator-p 'if) (special-operator-p 'car) (fboundp 'let) (fboundp 'nowhere)))
(print (multiple-value-list (find-symbol "PROGN" :cl)))
(print (multiple-value-list (find-symbol "BLOCK")))
(print (eq (read-from-string "unwind-protect") 'cl:unwind-protect))
(print (eq (intern "TAGBODY") 'cl:tagbody))
"""


def test_special_forms_are_known_without_the_compiler(folder: Path, tmp_path: Path) -> None:
    path = plan(tmp_path, INTROSPECTION)
    cold = said(path)
    assert said(path) == cold
    assert "(T NIL T NIL)" in cold and "(PROGN :EXTERNAL)" in cold and "(BLOCK :INHERITED)" in cold


def test_the_words_for_special_forms_are_all_of_them() -> None:
    interp = Interpreter(clock="virtual")
    interp.eval("nil")
    assert {s.name for s in interp.image.special_forms if not s.name.startswith("%")} == SPECIAL_FORMS


def test_a_macro_with_a_memory_is_expanded_at_every_run(folder: Path, tmp_path: Path) -> None:
    path = plan(
        tmp_path,
        "(defvar *tools* nil) (defmacro deftool (name) (push name *tools*) `(defun ,name () ',name))"
        "(deftool hammer) (deftool saw) (print *tools*)",
    )
    assert said(path) == said(path) == "\n(SAW HAMMER) "


def test_a_macro_from_another_file_is_part_of_the_key(folder: Path, tmp_path: Path) -> None:
    user = plan(tmp_path, "(print (scaled 3))", "user.esl")
    two = plan(tmp_path, "(defmacro scaled (n) `(* 2 ,n))", "two.esl")
    ten = plan(tmp_path, "(defmacro scaled (n) `(* 10 ,n))", "ten.esl")
    assert [said(two, user), said(ten, user), said(two, user)] == ["\n6 ", "\n30 ", "\n6 "]


def test_a_changed_text_is_compiled_anew(folder: Path, tmp_path: Path) -> None:
    path = plan(tmp_path, "(print 1)")
    assert said(path) == "\n1 "
    plan(tmp_path, "(print 2)")
    assert said(path) == "\n2 "


@pytest.mark.parametrize("damage", [b"", b"short", b"x" * 5000])
def test_a_damaged_cache_is_ignored(folder: Path, tmp_path: Path, damage: bytes) -> None:
    path = plan(tmp_path, "(print :fine)")
    said(path)
    for kept in folder.iterdir():
        kept.write_bytes(damage)
    assert said(path) == said(path) == "\n:FINE "


def test_a_cache_that_cannot_be_written_does_no_harm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    in_the_way = tmp_path / "file"
    in_the_way.write_text("not a folder")
    monkeypatch.setenv("ESLANG_CACHE", str(in_the_way / "cache"))
    assert said(plan(tmp_path, "(print :fine)")) == "\n:FINE "


def test_an_empty_name_turns_the_cache_off(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ESLANG_CACHE", "")
    assert cache.folder() is None


def test_a_text_that_is_wrong_is_not_kept(folder: Path, tmp_path: Path) -> None:
    path = plan(tmp_path, "(print 1) (print (")
    before = len(list(folder.iterdir()))
    for _ in range(2):
        with pytest.raises(EslError):
            said(path)
    assert len(list(folder.iterdir())) == before


def test_a_full_cache_forgets_what_was_not_used_for_longest(tmp_path: Path) -> None:
    for number in range(cache.MOST + 1):
        path = tmp_path / str(number)
        path.write_bytes(b"")
        os.utime(path, (number, number))
    cache.forget_old(str(tmp_path))
    left = sorted(int(path.name) for path in tmp_path.iterdir())
    assert left == list(range(cache.MOST // 2, cache.MOST + 1))


def test_functions_nested_very_deep_are_run_and_not_kept(folder: Path, tmp_path: Path) -> None:
    """Each variant of a function holds those inside it: keeping them all would never end."""
    before = set(folder.iterdir())
    path = plan(tmp_path, f"(print {'(funcall (lambda () ' * 300}7{'))' * 300})")
    assert [said(path).strip(), said(path).strip()] == ["7", "7"]
    assert set(folder.iterdir()) == before
