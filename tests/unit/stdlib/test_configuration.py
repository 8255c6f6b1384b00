"""Making devices ready (ARM §5): by which switch, which way, which device, and what is tried again."""

from __future__ import annotations

from collections.abc import Iterator
from io import StringIO

import pytest
from unit.devices.world import failure_of, state

from eslang import EslError, Interpreter
from eslang.base.spans import Source
from eslang.base.symbols import Keyword
from eslang.devices.scenario import begin_scenario, scenario_of

EGA_X, SPARE = Keyword("EGA_X"), Keyword("EGA_X_SPARE")


@pytest.fixture
def agent() -> Iterator[Interpreter]:
    """The small spacecraft, on virtual time; *SENT* holds the commands, the last first."""
    with Interpreter(clock="virtual", output=StringIO()) as made:
        made.eval("""
            (load-spacecraft) (device-power-state :neb1) (defvar *sent* nil)
            (let ((send #'send-command))
              (defun esl:send-command (device command)
                (push (list device command) *sent*)
                (funcall send device command)))
        """)
        yield made


def sent(agent: Interpreter) -> list[str]:
    """The commands that were sent, in order."""
    return [f"{device} {command}".lower() for device, command in agent.eval("(reverse *sent*)") or []]


def test_a_device_is_turned_on_by_its_switch_and_so_is_what_it_talks_through(agent: Interpreter) -> None:
    assert agent.eval("(make-ready :ega_x)") is EGA_X
    assert sent(agent) == [":acs_gde_ips_x_sw1 :turn-on", ":gde_sw :turn-on"]
    assert agent.eval("(list (device-ready-p :ega_x) (operate-device :ega_x))") == [True, True]


def test_what_is_ready_needs_no_command(agent: Interpreter) -> None:
    agent.eval("(progn (make-ready :ega_x) (setq *sent* nil) (make-ready :ega_x))")
    assert sent(agent) == []


def test_first_the_switch_is_simply_tried_again(agent: Interpreter) -> None:
    text = "(at 0 (break-device :camera_sw :stuck)) (at 1 (break-device :camera_sw :ok))"
    begin_scenario(agent, scenario_of(agent, Source("test.scenario", text)))
    assert agent.eval("(progn (sleep 0.3) (make-ready :camera))") is Keyword("CAMERA")
    assert sent(agent) == [":camera_sw :turn-on", ":camera_sw :turn-on"]


def test_then_the_redundant_switch_is_tried(agent: Interpreter) -> None:
    agent.eval("(break-device :acs_gde_ips_x_sw1 :stuck)")
    assert agent.eval("(make-ready :ega_x)") is EGA_X
    assert sent(agent)[:3] == [*[":acs_gde_ips_x_sw1 :turn-on"] * 2, ":acs_gde_ips_x_sw2 :turn-on"]


def test_then_the_redundant_device_is_tried(agent: Interpreter) -> None:
    agent.eval("(progn (break-device :acs_gde_ips_x_sw1 :stuck) (break-device :acs_gde_ips_x_sw2 :stuck))")
    assert agent.eval("(make-ready :ega_x)") is SPARE
    assert agent.eval("(device-ready-p :ega_x_spare)") is True


def test_if_nothing_helps_the_device_is_not_ready(agent: Interpreter) -> None:
    agent.eval(
        '(dolist (n \'(1 2 3)) (break-device (intern (format nil "ACS_GDE_IPS_X_SW~D" n) :keyword) :stuck))'
    )
    assert failure_of(agent, "(make-ready :ega_x)") == (":NOT-READY", ":EGA_X")
    assert len(sent(agent)) == 6


def test_a_device_that_is_broken_for_good_is_not_tried_again(agent: Interpreter) -> None:
    agent.eval("(break-device :ega_x :permanent-failure)")
    assert agent.eval("(make-ready :ega_x)") is SPARE
    assert ":ega_x :reset" not in sent(agent)


def test_what_the_diagnosis_calls_permanent_is_not_tried_again(agent: Interpreter) -> None:
    agent.eval("""
        (break-device :acs_gde_ips_x_sw1 :stuck)
        (setq *diagnosis-function* (lambda (device cause) (list device cause) :permanent))
    """)
    assert agent.eval("(make-ready :ega_x)") is EGA_X
    assert sent(agent)[:2] == [":acs_gde_ips_x_sw1 :turn-on", ":acs_gde_ips_x_sw2 :turn-on"]


def test_the_diagnosis_is_asked_of_who_is_to_blame(agent: Interpreter) -> None:
    agent.eval("""
        (defvar *asked* nil)
        (setq *diagnosis-function* (lambda (device cause) (push (list device cause) *asked*) :transient))
        (break-device :acs_gde_ips_x_sw1 :stuck)
        (make-ready :ega_x)
    """)
    assert agent.value("*asked*") == [[Keyword("ACS_GDE_IPS_X_SW1"), Keyword("NO-POWER")]]


def test_an_upset_is_reset(agent: Interpreter) -> None:
    agent.eval("(break-device :ega_x :single-event-upset)")
    assert agent.eval("(make-ready :ega_x)") is EGA_X
    assert sent(agent)[-1] == ":ega_x :reset"
    assert agent.eval("(operate-device :ega_x)") is True


def test_an_upset_on_the_way_is_reset_too(agent: Interpreter) -> None:
    agent.eval("(progn (make-ready :ega_x) (break-device :gde :single-event-upset) (sleep 1))")
    assert agent.eval("(device-ready-p :ega_x)") is None
    assert agent.eval("(make-ready :ega_x)") is EGA_X
    assert agent.eval("(device-ready-p :ega_x)") is True


def test_a_switch_that_is_upset_is_reset(agent: Interpreter) -> None:
    agent.eval("(progn (break-device :camera_sw :single-event-upset) (sleep 1))")
    assert agent.eval("(make-ready :camera)") is Keyword("CAMERA")
    assert sent(agent) == [f":camera_sw {command}" for command in (":turn-on", ":reset", ":turn-on")]


def test_a_bus_that_has_tripped_is_reset(agent: Interpreter) -> None:
    agent.eval("(progn (break-device :neb1 :tripped) (sleep 1))")
    assert agent.eval("(make-ready :camera)") is Keyword("CAMERA")
    assert [state(agent, ":neb1"), state(agent, ":camera")] == [":on", ":on"]


def test_a_bus_that_is_off_is_turned_on(agent: Interpreter) -> None:
    agent.eval("(turn-device-off :neb1)")
    assert agent.eval("(make-ready :camera)") is Keyword("CAMERA")


def test_what_is_always_too_much_for_its_bus_leaves_the_bus_on(agent: Interpreter) -> None:
    agent.eval("(assert '(powered-thru :oven :neb1)) (assert '(switched-thru :oven :oven_sw))")
    agent.eval("(assert '(power-draw :oven 500))")
    assert failure_of(agent, "(make-ready :oven)") == (":NOT-READY", ":OVEN")
    assert [state(agent, ":neb1"), state(agent, ":oven")] == [":on", ":off"]


def test_what_may_help_can_be_told_from_outside(agent: Interpreter) -> None:
    agent.eval("""
        (turn-device-off :bus_1553)
        (setq *device-recovery-function*
              (lambda (device cause)
                (and (eq cause :no-power) '((:heater :turn-on) (:camera :turn-on)))))
        (break-device :acs_gde_ips_x_sw1 :stuck) (setq *sent* nil)
    """)
    agent.eval("(make-ready :ega_x)")
    assert sent(agent)[1:3] == [":heater :turn-on", ":camera :turn-on"]


def test_a_second_way_is_taken_if_the_first_cannot_be_made_ready(agent: Interpreter) -> None:
    agent.eval("""
        (assert '(talks-thru :camera :radio)) (assert '(powered-thru :radio :neb1))
        (break-device :bus_1553 :permanent-failure) (sleep 1)
    """)
    assert agent.eval("(make-ready :camera)") is Keyword("CAMERA")
    assert agent.eval("(operate-device :camera)") is True


def test_a_way_that_leads_back_is_no_way(agent: Interpreter) -> None:
    agent.eval("(assert '(talks-thru :a :b)) (assert '(talks-thru :b :a))")
    assert failure_of(agent, "(make-ready :a)") == (":NOT-READY", ":A")


def test_two_tasks_may_make_devices_ready_at_once(agent: Interpreter) -> None:
    agent.eval("(task-net (a (make-ready :ega_x)) (b (make-ready :camera)))")
    assert agent.eval("(list (device-ready-p :ega_x) (device-ready-p :camera))") == [True, True]


def test_what_there_is_not_cannot_be_made_ready(agent: Interpreter) -> None:
    assert failure_of(agent, "(make-ready :ega_z)") == (":UNKNOWN-DEVICE", ":EGA_Z", ":EGA_X")


# --- goals ---------------------------------------------------------------------------


def test_the_states_of_a_device_are_goals_that_the_library_can_achieve(agent: Interpreter) -> None:
    agent.eval("(progn (achieve (power-state :camera :on)) (break-device :bus_1553 :ok))")
    assert state(agent, ":camera") == ":on"
    agent.eval(
        "(progn (break-device :camera :single-event-upset) (sleep 1) (achieve (health-state :camera :ok)))"
    )
    assert state(agent, ":camera", "health-state") == ":ok"
    agent.eval("(achieve (power-state :camera :off))")
    assert state(agent, ":camera") == ":off"


def test_the_goal_of_a_device_may_be_a_variable(agent: Interpreter) -> None:
    agent.eval("(with-query-bindings '(is-a ?device :camera) (achieve (power-state #?device :on)))")
    assert state(agent, ":camera") == ":on"


def test_what_a_program_says_of_a_goal_comes_before_what_the_library_knows(agent: Interpreter) -> None:
    agent.eval("(to-achieve (power-state ?device ?state) (t (assert '(power-state #?device :mine))))")
    assert failure_of(agent, "(achieve (power-state :camera :on))")[0] == ":CONDITION-NOT-ACHIEVED"
    assert state(agent, ":camera") == ":mine"


def test_a_program_may_take_the_place_of_what_the_library_knows(agent: Interpreter) -> None:
    agent.eval("(to-achieve (power-state ?it :on) (t (print '#?it)))")
    assert failure_of(agent, "(achieve (power-state :camera :on))")[0] == ":CONDITION-NOT-ACHIEVED"
    agent.eval("(to-achieve (power-state ?that :on) (t (turn-device-on #?that)))")
    assert agent.eval("(achieve (power-state :camera :on))") is True


def test_of_what_is_no_device_the_library_knows_nothing(agent: Interpreter) -> None:
    assert failure_of(agent, "(achieve (power-state lamp :on))")[0] == ":NO-APPLICABLE-METHOD"


# --- ready as long as it is needed ---------------------------------------------------


def test_a_device_is_ready_inside_and_its_components_are_locked(agent: Interpreter) -> None:
    form = """(with-ready-device (actuator :ega_x)
                (list actuator (device-ready-p actuator) (operate-device actuator)))"""
    assert agent.eval(form) == [EGA_X, True, True]
    wanted = agent.eval("(with-ready-device (camera :camera) (ready-properties camera))")
    assert [str(each[0]).lower() for each in wanted] == [
        "power-state",
        "power-state",
        "health-state",
        "health-state",
    ]


def test_the_values_of_the_body_come_back(agent: Interpreter) -> None:
    form = "(multiple-value-list (with-ready-device (camera :camera) (values 1 camera)))"
    assert agent.eval(form) == [1, Keyword("CAMERA")]


def test_what_cannot_be_made_ready_is_replaced(agent: Interpreter) -> None:
    agent.eval("(break-device :ega_x :permanent-failure)")
    assert agent.eval("(with-ready-device (actuator :ega_x) actuator)") is SPARE


def test_if_nothing_can_be_made_ready_the_form_fails(agent: Interpreter) -> None:
    agent.eval("(break-device :camera_sw :stuck)")
    assert failure_of(agent, "(with-ready-device (camera :camera) camera)") == (":NOT-READY", ":CAMERA")


def test_a_failure_of_the_body_is_no_reason_to_take_another_device(agent: Interpreter) -> None:
    form = "(with-ready-device (actuator :ega_x) (fail :condition-not-achieved '(something else)))"
    assert failure_of(agent, form)[0] == ":CONDITION-NOT-ACHIEVED"
    assert state(agent, ":ega_x_spare") == ":off"


def test_who_wants_the_contrary_does_not_get_its_lock(agent: Interpreter) -> None:
    form = """(with-ready-device (camera :camera)
                (with-maintained-properties ((power-state :bus_1553 :off)) nil))"""
    assert failure_of(agent, form)[0] == ":PROPERTY-LOCK-UNAVAILABLE"


def test_what_is_lost_inside_is_recovered_for_those_who_wait(agent: Interpreter) -> None:
    agent.eval("(spawn (progn (sleep 5) (break-device :neb1 :tripped)))")
    form = """(with-ready-device (actuator :ega_x)
                (with-automatic-recoveries (sleep 20) (operate-device actuator)))"""
    assert agent.eval(form) is True


def test_what_is_lost_inside_is_a_failure_for_those_who_do_not(agent: Interpreter) -> None:
    agent.eval("(spawn (progn (sleep 5) (turn-device-off :camera)))")
    form = "(with-ready-device (camera :camera) (sleep 20) camera)"
    assert failure_of(agent, form)[0] == ":MAINTAINED-PROPERTY-VIOLATION"


def test_two_tasks_may_keep_the_same_device_ready(agent: Interpreter) -> None:
    form = """(multiple-value-list
                (task-net (a (with-ready-device (camera :camera) (sleep 5) camera))
                          (b (with-ready-device (camera :camera) (sleep 9) (operate-device camera)))))"""
    assert agent.eval(form) == [Keyword("CAMERA"), True]
    assert sent(agent).count(":camera_sw :turn-on") == 1


def test_devices_that_talk_through_each_other_are_never_ready(agent: Interpreter) -> None:
    agent.eval("""(dolist (fact '((talks-thru :x :y) (talks-thru :y :x)
                                  (powered-thru :x :neb1) (powered-thru :y :neb1)))
                    (assert fact))""")
    agent.eval("(progn (turn-device-on :x) (turn-device-on :y))")
    assert agent.eval("(device-ready-p :x)") is None
    assert len(agent.eval("(ready-properties :x)")) == 4
    assert failure_of(agent, "(make-ready :x)") == (":NOT-READY", ":X")


@pytest.mark.parametrize("form", ["(with-ready-device :ega_x 1)", "(with-ready-device (x) 1)"])
def test_a_device_without_a_variable_is_refused_before_the_run(agent: Interpreter, form: str) -> None:
    with pytest.raises(EslError, match="with-ready-device"):
        agent.eval(f"(defun f () {form})")
