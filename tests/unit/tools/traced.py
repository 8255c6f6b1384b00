"""Traces for tests: plans in which much happens, run on virtual time."""

from __future__ import annotations

from io import StringIO
from typing import Any

from eslang import Failure, Interpreter
from eslang.tools.trace_reading import Trace, read_lines
from eslang.tools.tracing import Tracer

RESCUE = """
(defevent cup-seen)
(defun fetch ()
  (with-recovery-procedures ((:slipped :retries 2 (sleep 1) (retry)))
    (sleep 2)
    (fail :slipped "left hand" 3)))
(defun battery () (sleep 4))
(defun radio () (sleep 5) :radio)
(defun laser () (sleep 2) :laser)
(with-recovery-procedures ((:general-failure (abort :gave-up)))
  (task-net
    (watcher (wait-for-events cup-seen)
             (checkpoint :ready)
             (with-cleanup-procedure (princ "cleaning ") (sleep 100)))
    (camera (sleep 1) (signal cup-seen :left 3) (with-deadline (5) (loop (sleep 1))))
    (arm (checkpoint-wait watcher :ready) (fetch))
    (guarded (with-guardian (battery) (princ "alarm ") (sleep 20)))
    (either (or-parallel (radio) (laser)))))
"""
EVERY_KIND = """
(defvar *up* nil)
(defun up? () *up*)
(to-achieve (up?) (t (setq *up* t)))
(achieve (up?))
(add-goal (achieve (up?)))
(pursue-goals)
(handler-case (fail :taken) (error (e) 1))
(handler-case (car 5) (error (e) 1))
(let ((turns 0))
  (periodically 1 (sleep 2.5) (if (= (incf turns) 2) (return))))
(task-net (a (wait-until (at robot dock))) (b (yield) (assert '(at robot dock))))
(define-resource power :capacity 5)
(with-resource (power 3) (sleep 1))
(scs:do (scs:do :when (> 1 2) (princ "never")) (princ "once"))
(fail :over)
(task-net (a (checkpoint-wait b :never)) (b (checkpoint-wait a :never)))
(quit 3)
"""


def told(text: str, seed: int = 0) -> list[Any]:
    """The events of a run of TEXT, form by form, whatever becomes of the forms."""
    heard: list[Any] = []
    run(text, [heard.append], seed)
    return heard


def written(text: str, seed: int = 0, name: str = "plan.esl") -> str:
    """The trace of a run of TEXT, as `--trace` writes it."""
    stream = StringIO()
    tracer = Tracer(stream, {"clock": "virtual", "seed": seed, "plans": [name]})
    time = run(text, [tracer], seed, name)
    stream.close, kept = (lambda: None), stream  # type: ignore[method-assign]
    tracer.close(time)
    return kept.getvalue()


def traced(text: str, seed: int = 0) -> Trace:
    """The same, read back."""
    return read_lines("plan.jsonl", written(text, seed).encode())


def run(text: str, listeners: list[Any], seed: int, name: str = "plan.esl") -> float:
    """Run TEXT; when it ended."""
    from eslang.base.control import Stop
    from eslang.base.spans import Source

    with Interpreter(clock="virtual", seed=seed, output=StringIO(), listeners=listeners) as interp:
        for reading in interp.readings(Source(name, text)):
            try:
                interp.evaluate(reading)
            except (Failure, Stop):
                continue
        return interp.clock.now()
