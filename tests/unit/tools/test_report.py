"""Reports, whole: of deadlocks, and of failures that came from other tasks."""

from __future__ import annotations

from pathlib import Path

import pytest
from unit.tools.command import call

REPORTS = {
    "a net that waits in a circle": (
        """\
(task-net (t1 (checkpoint-wait t2 :cp) (checkpoint :cp))
          (t2 (checkpoint-wait t1 :cp) (checkpoint :cp)))
""",
        """\
plan.esl:1:1: error: deadlock: 2 tasks wait, and nothing can wake them
  t1  waits for checkpoint :cp of t2  plan.esl:1:15
      t2 has not come to its (checkpoint :cp)
  t2  waits for checkpoint :cp of t1  plan.esl:2:15
      t1 has not come to its (checkpoint :cp)
  = in    main, which waits for the end of t1, t2
  = hint  each waits for the other; let one of them pass its checkpoint first
""",
    ),
    "the paper's example as it is printed": (
        """\
(task-net
  (t1 (print 1) (checkpoint-wait t2 :cp) (print 3))
  (t2 (print 2) (wait-for-task t1) (print 4)))
""",
        """\
plan.esl:1:1: error: deadlock: 2 tasks wait, and nothing can wake them
  t1  waits for checkpoint :cp of t2  plan.esl:2:17
      t2 never signals it: no (checkpoint :cp) stands in its body
  t2  waits for the end of t1         plan.esl:3:17
  = in    main, which waits for the end of t1, t2
  = hint  let t2 pass `(checkpoint :cp)`
""",
    ),
    "a spawned task that nobody signals": (
        """\
(defevent cup-seen)
(spawn (wait-for-events cup-seen) :name :gripper)
""",
        """\
plan.esl:2:8: error: deadlock: 1 task waits, and nothing can wake it
  gripper  waits for event cup-seen  plan.esl:2:8
           no task that is left signals it by name
  = hint  let a task that does not wait `(signal cup-seen)`
""",
    ),
    "a failure that a net passes on": (
        """\
(defun lift (cup)
  (car cup))
(defun mission ()
  (with-cleanup-procedure (list :done)
    (task-net (left (sleep 1))
              (right (lift 5)))))
(mission)
""",
        """\
plan.esl:2:3: failure: :TYPE-ERROR 5 LIST
  |
2 |   (car cup))
  |   ^^^^^^^^^ the value 5 is not of type LIST
  in lift                    plan.esl:2:3
  in task right              plan.esl:6:22
  in with-cleanup-procedure  plan.esl:5:5
  in mission                 plan.esl:4:3
  in top level               plan.esl:7:1
""",
    ),
    "a failure of a spawned task's net that nobody saw": (
        """\
(defun dig ()
  (task-net (arm (sleep 1) (fail :stuck :arm 3))))
(defun main ()
  (spawn (dig) :name :digger)
  (print :main))
""",
        """\
plan.esl:2:28: failure: :STUCK :ARM 3
  |
2 |   (task-net (arm (sleep 1) (fail :stuck :arm 3))))
  |                            ^^^^^^^^^^^^^^^^^^^^ raised here
  in task arm     plan.esl:2:28
  in dig          plan.esl:2:3
  in task digger  plan.esl:4:10
""",
    ),
    "the bodies of constructs are called as these are": (
        """\
(defun look ()
  (with-recovery-procedures ((:other 1))
    (with-deadline (5)
      (car (lambda () 5)))))
(funcall (lambda () (look)))
""",
        """\
plan.esl:4:7: failure: :TYPE-ERROR #<FUNCTION LAMBDA> LIST
  |
4 |       (car (lambda () 5)))))
  |       ^^^^^^^^^^^^^^^^^^^ the value #<FUNCTION LAMBDA> is not of type LIST
  in with-deadline             plan.esl:4:7
  in with-recovery-procedures  plan.esl:3:5
  in look                      plan.esl:2:3
  in lambda                    plan.esl:5:21
  in top level                 plan.esl:5:1
""",
    ),
}


@pytest.mark.parametrize("name", REPORTS)
def test_report(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    plan, report = REPORTS[name]
    Path("plan.esl").write_text(plan)
    code, _, err = call(["run", "--quiet", "--clock", "virtual", "plan.esl"])
    assert (code, err) == (1, report)


def test_the_owner_of_a_lock_that_cannot_achieve_it_is_told_of_once() -> None:
    ended = call(
        ["run", "-e", "(defproperty lamp)", "-e", "(spawn (with-maintained-properties ((lamp :on)) 1))"]
    )
    assert ended.code == 1
    assert ended.err.count("in task with-maintained-properties") == 1
