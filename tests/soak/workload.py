"""What the soak does, round by round, and how much memory that leaves behind."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from typing import NamedTuple

from eslang import Interpreter

PLAN = """
(defevent ping) (defevent pong) (defevent done)
(defvar *level* 0) (defvar *d* 0) (defvar *kept* nil)

(defun rally ()
  (task-net (b (dotimes (i 10) (wait-for-events ping) (yield) (signal pong)))
            (a (dotimes (i 10) (signal ping i) (wait-for-events pong)))))

(defun crowd ()
  (let ((tasks nil))
    (dotimes (i 8) (push (spawn (let ((*d* i)) (sleep 0.01) (checkpoint :half) (yield) *d*)) tasks))
    (checkpoint-wait (first tasks) :half)
    (dolist (task tasks) (wait-for-task task))))

(defun in-time ()
  (dotimes (i 5)
    (with-deadline (100) (sleep 0.01))
    (with-recovery-procedures (:deadline-expired (abort)) (with-deadline (0.01) (sleep 100)))))

(defun failing ()
  (with-recovery-procedures ((:lost :retries 2 (yield) (retry)) (:lost (abort)))
    (task-net (a (with-cleanup-procedure (sleep 0.01) (wait-for-events done)))
              (b (task-net (c (yield) (fail :lost 1)) (d (unwind-protect (sleep 9) (yield)))))))
  (with-recovery-procedures (:error (abort)) (task-net (a (car 5))))
  (task-net :allow-failures (a (fail :x)) (b (yield)) (c (fail :y)))
  (or-parallel (progn (sleep 0.01) 1) (wait-for-events done) (fail :x)))

(defun watched ()
  (with-recovery-procedures (:alarm (abort))
    (with-guardian (sleep 0.01) (fail :alarm) (with-cleanup-procedure (yield) (sleep 9))))
  (with-guardian (wait-until (= *level* -1)) (fail :alarm) (sleep 0.01))
  (task-net (a (wait-until (= *level* 1) :timeout 100) (setq *level* 0))
            (b (yield) (setq *level* 1))
            (c (with-recovery-procedures (:timeout (abort)) (wait-until (= *level* 2) :timeout 0.01)))))

(defun meddling ()
  (let ((sleeper (spawn (with-cleanup-procedure (yield) (catch 'out (sleep 100)) (sleep 100)))))
    (yield)
    (interrupt-task sleeper (lambda () (yield)))
    (yield)
    (interrupt-task sleeper (lambda () (throw 'out 1)))
    (without-interrupts (sleep 0.01))
    (abort-task sleeper)
    (wait-for-task sleeper))
  (let ((unborn (spawn (yield)))) (abort-task unborn))
  (block b (let ((me (current-task))) (spawn (interrupt-task me (lambda () (return-from b 1)))) (sleep 9)))
  (dotimes (i 2500) i))

(defun deadlocked ()
  (with-recovery-procedures (:deadlock (abort))
    (task-net (a (with-cleanup-procedure (wait-for-task b) (wait-for-events done)))
              (b (with-cleanup-procedure (wait-for-task a) (wait-for-events done))))))

(defun all ()
  (rally) (crowd) (in-time) (failing) (watched) (meddling) (deadlocked))
"""


class Taken(NamedTuple):
    """What was taken up at one moment."""

    rounds: int
    steps: int
    objects: int  # that Python's collector of garbage knows
    megabytes: float  # resident; 0 where the system does not tell


class Soak:
    """One interpreter that does the same again and again."""

    def __init__(self) -> None:
        self.interp = Interpreter(clock="virtual", output=Nowhere())
        self.interp.eval(PLAN)
        self.rounds = 0

    @property
    def steps(self) -> int:
        """How many steps were made."""
        return self.interp.scheduler.steps

    def run(self, steps: int) -> Taken:
        """Go on until STEPS more were given; what is taken up then."""
        goal = self.steps + steps
        while self.steps < goal:
            self.interp.call("all")
            self.rounds += 1
        gc.collect()
        return Taken(self.rounds, self.steps, len(gc.get_objects()), resident())

    def series(self, steps: int, parts: int) -> Iterator[Taken]:
        """The same in PARTS."""
        for _ in range(parts):
            yield self.run(steps // parts)


class Nowhere:
    """Where what is written goes."""

    def write(self, text: str) -> int:
        """Forget TEXT."""
        return len(text)

    def flush(self) -> None:
        """Nothing is kept."""


def resident() -> float:
    """How many megabytes of memory this process has, where the system tells."""
    try:
        with open("/proc/self/statm") as statm:
            pages = int(statm.read().split()[1])
    except OSError:
        return 0.0
    from resource import getpagesize

    return pages * getpagesize() / 2**20
