"""The spacecraft: its commands, what they need, and what is seen of them."""

from __future__ import annotations

import pytest
from unit.devices.world import LAMP, craft, failure_of, state

from eslang.base.symbols import Keyword
from support import run

EGA_X_AS_PRINTED = """
    (IS-A :EGA_X :EGA_X_FACING) (TALKS-THRU :EGA_X :GDE) (POWERED-THRU :EGA_X :NEB1)
    (SWITCHED-THRU :EGA_X
    :ACS_GDE_IPS_X_SW1)
    (:HEALTH_STATE :EGA_X :OK)
    (:POWER_STATE :EGA_X :OFF)
"""


# --- power ---------------------------------------------------------------------------


def test_a_device_is_turned_on_by_its_switch_and_the_facts_say_so() -> None:
    with craft() as agent:
        assert agent.eval("(turn-device-on :lamp)") is Keyword("ON")
        assert state(agent, ":lamp") == ":on"


def test_a_command_takes_the_latency_of_the_device_and_of_the_sensors() -> None:
    with craft(LAMP + "(command-latency :lamp 2) (sensor-latency :lamp 3) (sensor-latency :bus 50)") as agent:
        agent.eval("(turn-device-on :lamp)")
        assert agent.clock.now() == 5.0


def test_other_tasks_go_on_while_a_command_is_under_way() -> None:
    with craft() as agent:
        said = agent.eval(
            "(let (said) (spawn (progn (sleep 0.1) (push :other said))) (turn-device-on :lamp) said)"
        )
        assert said == [Keyword("OTHER")]


def test_a_command_works_although_who_sent_it_is_gone() -> None:
    with craft() as agent:
        body = "(with-deadline (0.1) (turn-device-on :lamp))"
        agent.eval(f"(with-recovery-procedures (:deadline-expired (abort)) {body})")
        assert state(agent, ":lamp") == ":off"
        agent.eval("(sleep 1)")
        assert state(agent, ":lamp") == ":on"


def test_what_sensors_see_is_a_fact_only_after_their_latency() -> None:
    with craft(LAMP + "(sensor-latency :lamp 2)") as agent:
        agent.eval("(spawn (turn-device-on :lamp) :daemon t)")
        agent.eval("(sleep 0.6)")
        assert state(agent, ":lamp") == ":off"
        agent.eval("(sleep 2)")
        assert state(agent, ":lamp") == ":on"


def test_a_switch_is_a_device_and_the_second_one_works_as_the_first() -> None:
    with craft() as agent:
        agent.eval("(turn-device-on :sw2)")
        assert state(agent, ":lamp") == ":on"
        assert agent.eval("(device-power-state :sw2)") is None


def test_a_device_is_turned_off_by_all_its_switches() -> None:
    with craft() as agent:
        agent.eval("(progn (turn-device-on :sw1) (turn-device-on :sw2) (turn-device-off :lamp))")
        assert state(agent, ":lamp") == ":off"


def test_a_device_without_a_switch_has_a_relay_of_its_own() -> None:
    with craft("(powered-thru :gde :bus)") as agent:
        agent.eval("(turn-device-on :gde)")
        assert state(agent, ":gde") == ":on"


def test_a_device_begins_as_the_facts_say() -> None:
    with craft(LAMP + "(power-state :lamp :on)") as agent:
        agent.eval("(turn-device-off :sw1)")
        assert state(agent, ":lamp") == ":off"


def test_what_the_facts_do_not_tell_is_found_out_when_the_spacecraft_is_first_spoken_to() -> None:
    with craft() as agent:
        assert agent.eval("(device-power-state :lamp)") is Keyword("OFF")
        assert [state(agent, ":bus"), state(agent, ":lamp", "health-state")] == [":on", ":ok"]


def test_facts_that_say_too_much_are_corrected_by_the_sensors() -> None:
    with craft(LAMP + "(power-state :lamp :on) (power-state :bus :off)") as agent:
        agent.eval("(progn (device-power-state :lamp) (sleep 1))")
        assert state(agent, ":lamp") == ":off"


def test_the_description_may_grow() -> None:
    with craft() as agent:
        agent.eval("(progn (turn-device-on :lamp) (assert '(powered-thru :fan :bus)) (turn-device-on :fan))")
        assert [state(agent, ":lamp"), state(agent, ":fan")] == [":on", ":on"]


def test_rules_may_describe_too() -> None:
    with craft("(is-a :a :lamp)") as agent:
        agent.eval("(defrule (powered-thru ?lamp :bus) (is-a ?lamp :lamp))")
        assert agent.eval("(turn-device-on :a)") is Keyword("ON")


def test_the_listing_of_the_paper_is_a_description() -> None:
    with craft(EGA_X_AS_PRINTED) as agent:
        agent.eval("(turn-device-on :ega_x)")
        assert state(agent, ":ega_x") == ":on"
        assert agent.eval("(db-query '(:power_state ?x ?y))") is None


def test_the_query_of_the_paper_finds_a_healthy_device() -> None:
    with craft(EGA_X_AS_PRINTED) as agent:
        found = agent.eval(
            "(progn (turn-device-on :ega_x) (db-query '(and (is-a ?x ?type) (health-state ?x :ok))))"
        )
        assert len(found) == 1


# --- faults --------------------------------------------------------------------------


def test_a_stuck_switch_is_seen_only_as_power_that_does_not_come() -> None:
    with craft() as agent:
        agent.eval("(break-device :sw1 :stuck)")
        assert failure_of(agent, "(turn-device-on :lamp)") == (":NO-POWER", ":LAMP", ":SW1")
        assert agent.eval("(turn-device-on :sw1)") is Keyword("ON")
        assert [state(agent, ":lamp"), state(agent, ":sw1", "health-state")] == [":off", ":ok"]


def test_a_switch_that_sticks_while_it_is_on_keeps_the_power_on() -> None:
    with craft() as agent:
        agent.eval("(progn (turn-device-on :lamp) (break-device :sw1 :stuck))")
        assert failure_of(agent, "(turn-device-off :lamp)") == (":POWER-STAYS", ":LAMP", ":SW1")


def test_an_upset_keeps_a_device_from_answering_until_it_is_reset() -> None:
    with craft() as agent:
        agent.eval("(progn (turn-device-on :lamp) (break-device :lamp :single-event-upset))")
        assert failure_of(agent, "(operate-device :lamp)")[:2] == (":NO-ANSWER", ":LAMP")
        assert agent.eval("(reset-device :lamp)") is Keyword("OK")
        assert agent.eval("(operate-device :lamp)") is True


def test_a_reset_does_not_mend_a_permanent_failure() -> None:
    with craft() as agent:
        agent.eval("(progn (turn-device-on :lamp) (break-device :lamp :permanent-failure))")
        expected = (":NO-ANSWER", ":LAMP", ":PERMANENT-FAILURE")
        assert failure_of(agent, "(reset-device :lamp)") == expected


def test_health_is_seen_only_of_a_device_that_has_power() -> None:
    with craft() as agent:
        agent.eval("(progn (break-device :lamp :single-event-upset) (sleep 10))")
        assert state(agent, ":lamp", "health-state") == ":ok"
        agent.eval("(turn-device-on :lamp)")
        assert state(agent, ":lamp", "health-state") == ":single-event-upset"


def test_a_switch_that_is_upset_does_not_obey_until_it_is_reset() -> None:
    with craft() as agent:
        agent.eval("(break-device :sw1 :single-event-upset)")
        assert failure_of(agent, "(turn-device-on :lamp)")[0] == ":NO-POWER"
        agent.eval("(progn (reset-device :sw1) (turn-device-on :lamp))")
        assert state(agent, ":lamp") == ":on"


def test_what_is_mended_is_as_new() -> None:
    with craft() as agent:
        agent.eval("(progn (break-device :sw1 :stuck) (break-device :sw1 :ok) (turn-device-on :lamp))")
        assert state(agent, ":lamp") == ":on"


def test_a_broken_bus_feeds_nothing() -> None:
    with craft() as agent:
        agent.eval("(progn (turn-device-on :lamp) (break-device :bus :permanent-failure) (sleep 1))")
        assert [state(agent, ":lamp"), state(agent, ":bus")] == [":off", ":off"]
        assert failure_of(agent, "(turn-device-on :lamp)") == (":NO-POWER", ":LAMP", ":BUS")


def test_a_condition_over_what_a_sensor_tells_wakes_who_waits() -> None:
    with craft() as agent:
        agent.eval("(turn-device-on :lamp)")
        agent.eval("(spawn (progn (sleep 5) (break-device :lamp :single-event-upset)))")
        agent.eval("(wait-until (eq (device-health-state :lamp) :single-event-upset))")
        assert agent.clock.now() == pytest.approx(5.7)


def test_a_condition_over_facts_wakes_who_waits() -> None:
    with craft() as agent:
        agent.eval("(turn-device-on :lamp)")
        agent.eval("(spawn (progn (sleep 5) (break-device :bus :tripped)))")
        agent.eval("(wait-until (power-state :lamp :off))")
        assert agent.clock.now() == pytest.approx(5.7)


# --- messages ------------------------------------------------------------------------

ACTUATOR = "(talks-thru :ega :gde) (talks-thru :gde :wire) (power-state :ega :on) (power-state :gde :on)"


def test_a_message_needs_every_part_of_the_way() -> None:
    with craft(ACTUATOR) as agent:
        assert failure_of(agent, "(operate-device :ega)") == (":NO-PATH", ":EGA", ":WIRE")
        agent.eval("(turn-device-on :wire)")
        assert agent.eval("(operate-device :ega)") is True
        agent.eval("(break-device :gde :single-event-upset)")
        assert failure_of(agent, "(operate-device :ega)") == (":NO-PATH", ":EGA", ":GDE")


def test_a_second_way_serves_as_well() -> None:
    with craft(ACTUATOR + "(talks-thru :gde :spare_wire) (power-state :spare_wire :on)") as agent:
        assert agent.eval("(operate-device :ega)") is True


def test_one_message_at_a_time_passes_a_bus() -> None:
    with craft(ACTUATOR + "(power-state :wire :on) (message-time :wire 10)") as agent:
        agent.eval("(task-net (a (operate-device :ega)) (b (operate-device :gde)))")
        assert agent.clock.now() == pytest.approx(20.7)


# --- mistakes ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("form", "expected"),
    [
        ("(turn-device-on :lmap)", (":UNKNOWN-DEVICE", ":LMAP", ":LAMP")),
        ("(turn-device-on :nothing-like-it)", (":UNKNOWN-DEVICE", ":NOTHING-LIKE-IT", "None")),
        ('(reset-device "lamp")', (":UNKNOWN-DEVICE", "lamp", "None")),
        ("(device-power-state '(a b))", (":UNKNOWN-DEVICE", "['A', 'B']", "None")),
        ("(break-device :lamp :tripped)", (":UNKNOWN-HEALTH", ":TRIPPED", "None")),
        ("(send-command :lamp :turn-of)", (":UNKNOWN-COMMAND", ":TURN-OF", ":TURN-OFF")),
        (
            "(break-device :lamp :permanent-failur)",
            (":UNKNOWN-HEALTH", ":PERMANENT-FAILUR", ":PERMANENT-FAILURE"),
        ),
    ],
)
def test_what_there_is_not_is_named_with_the_nearest_name(form: str, expected: tuple[str, ...]) -> None:
    with craft() as agent:
        found = failure_of(agent, form)
        assert found[0] == expected[0]
        assert found[2] == expected[2]


def test_one_procedure_answers_every_command_that_fails() -> None:
    text = """(load-spacecraft) (break-device :camera_sw :stuck)
              (with-recovery-procedures (((:command-failed device who) (princ (list device who)) (abort)))
                (turn-device-on :camera))"""
    assert run(text).output.split("\n")[-1] == "(CAMERA CAMERA_SW)"


# --- a description that is wrong -----------------------------------------------------

WRONG = [
    "(power-draw :lamp ten)",
    "(power-draw :lamp -1)",
    "(command-latency :lamp t)",
    '(bus-capacity :bus "100")',
    "(powered-thru :lamp 5)",
]


@pytest.mark.parametrize("fact", WRONG)
def test_a_fact_that_describes_nothing_is_named_when_the_device_is_spoken_to(fact: str) -> None:
    with craft() as agent:
        agent.eval(f"(progn (turn-device-on :lamp) (assert '{fact}))")
        assert failure_of(agent, "(turn-device-off :lamp)")[0] == ":WRONG-DESCRIPTION"
        said = "(with-recovery-procedures (((:wrong-description f) (abort f))) (turn-device-off :lamp))"
        assert agent.eval(f"(equal '{fact} {said})") is True


def test_a_number_above_all_floats_is_no_description() -> None:
    with craft() as agent:
        agent.eval("(assert (list 'power-draw :lamp (expt 10 400)))")
        assert failure_of(agent, "(turn-device-on :lamp)")[0] == ":WRONG-DESCRIPTION"


def test_what_was_wrong_and_is_repaired_is_as_it_was() -> None:
    with craft() as agent:
        agent.eval("(progn (turn-device-on :lamp) (assert '(powered-thru :lamp 5)))")
        failure_of(agent, "(device-power-state :lamp)")
        agent.eval("(retract '(powered-thru :lamp 5))")
        assert str(agent.eval("(device-power-state :lamp)")) == ":ON"
