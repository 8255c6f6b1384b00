"""Plans for tests of faults: each uses constructs of one kind, and each ends the same way in any order.

So what is done to it between two steps, if it does nothing, changes nothing.
"""

from __future__ import annotations

PLANS = {
    "net": """
        (let ((found nil))
          (task-net (a (sleep 1) (cleaned (sleep 1) (push :a found) (checkpoint :a)))
                    (b (checkpoint-wait a :a) (protected (sleep 1) (yield) (note :b)) (push :b found))
                    (c (wait-for-task b) (push :c found)))
          (reverse found))""",
    "failing-net": """
        (with-recovery-procedures ((:lost :retries 1 (note :lost) (retry)) (:lost (abort :gave-up)))
          (task-net (a (cleaned (progn (sleep 0.5) (note :a-cleaned)) (sleep 9)))
                    (b (sleep 1) (fail :lost 1))
                    (c (cleaned (fail :in-cleanup) (wait-for-events *e1*)))))""",
    "lenient-net": """
        (multiple-value-list
          (task-net :allow-failures
            (a (sleep 1) :a) (b (cleaned (sleep 1) (fail :b))) (c (task-net (d (fail :d)) (e
                (sleep 5))))))""",
    "race": """
        (or-parallel (cleaned (fail :loser) (sleep 5) 1)
                     (progn (sleep 1) (protected (sleep 1) (sleep 0.5)) (values 2 3))
                     (fail :early)
                     (wait-for-events *e1*))""",
    "guardians": """
        (with-recovery-procedures (:inner :retries 2 (retry))
          (with-guardian (progn (sleep 3) (cleaned (yield) (sleep 9))) (note :outer)
            (with-guardian (sleep 1) (fail :inner)
              (with-recovery-procedures (:inner (note :answered))
                (cleaned (sleep 0.5) (sleep 2))
                (sleep 0.5)
                :done))))""",
    "deadlines": """
        (with-recovery-procedures (:deadline-expired (sleep 1) (abort :late))
          (with-deadline (3)
            (protected (with-deadline (5) (with-recovery-procedures (:deadline-expired (note :never))
                                            (without-interrupts (sleep 4))
                                            (sleep 4)))
              (with-recovery-procedures (:deadline-expired (note :cleanup-late) (abort))
                (with-deadline (1) (sleep 2))))))""",
    "spawning": """
        (let ((child (spawn (progn (spawn (cleaned (yield) (sleep 2) (note :grandchild))) (sleep 1) :child)))
              (daemon (spawn (cleaned (sleep 1) (wait-for-events *e2*)) :daemon t)))
          (sleep 0.5)
          (abort-task daemon)
          (list (wait-for-task child) (wait-for-task daemon) (task-status daemon)))""",
    "conditions": """
        (progn
          (setq *v1* 0 *v2* 0)
          (task-net (a (wait-until (= *v1* 3)) (setq *v2* 1) :a)
                    (b (dotimes (i 3) (sleep 1) (incf *v1*)) (wait-until (= *v2* 1)) :b)
                    (c (with-recovery-procedures (:timeout (abort :none))
                         (wait-until (= *v1* 99) :timeout 1.5)))))""",
    "interrupts": """
        (let ((sleeper (spawn (progn (cleaned (sleep 1) (sleep 2)) (protected (sleep 1) (sleep 1)) :slept))))
          (sleep 0.5)
          (interrupt-task sleeper (lambda () (note :one) (sleep 0.5)))
          (interrupt-task sleeper (lambda () (note :two)))
          (without-interrupts (interrupt-task (current-task) (lambda () (note :mine))) (sleep 1)
              (note :not-yet))
          (wait-for-task sleeper))""",
    "recoveries": """
        (with-recovery-procedures ((:a :retries 2 (task-net (x (sleep 1)) (y (sleep 0.5))) (retry))
                                   (:a (cleaned (sleep 1) (sleep 0.5)) (abort :end)))
          (task-net (n (cleaned (sleep 0.5) (sleep 0.5) (let ((*d* 4)) (yield) (here 4) (fail :a))))
                    (m (cleaned (with-recovery-procedures (:b (abort 1)) (sleep 0.5) (fail :b))
                        (sleep 8)))))""",
    "loops": """
        (task-net (a (dotimes (i 6000) i) (note :a))
                  (b (let ((n 0)) (periodically 1 (if (= (incf n) 3) (return n)) (sleep 0.5))))
                  (c (catch 'out (mapcar (lambda (x) (yield) (if (= x 2) (throw 'out x))) '(1 2 3))))
                  (d (through (lambda () (sort (list 3 1 2) (lambda (x y) (yield) (< x y)))))))""",
    "no-way-out": """
        (with-recovery-procedures (:deadlock (note :deadlock) (abort :left))
          (task-net (a (cleaned (wait-for-task b) (wait-for-events *e1*)))
                    (b (cleaned (wait-for-task a) (wait-for-events *e1*)))))""",
}
