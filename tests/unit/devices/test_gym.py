"""The environments of Gymnasium, where it is installed (`pip install eslang[gym]`)."""

from __future__ import annotations

import re
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

from eslang.tools.cli import main
from support import check_program, lines_of, run

ROOT = Path(__file__).resolve().parents[3]
LANDER = ROOT / "plans" / "scs" / "08-lunar-lander.esl"
PAGE = ROOT / "docs" / "how-to" / "act-in-gymnasium.md"
CART = """(make-environment "CartPole-v1" :name :cart :seed 3 :sensors '(:place :speed :lean :sway))"""
needs_gymnasium = pytest.mark.skipif(find_spec("gymnasium") is None, reason="pip install eslang[gym]")
needs_box2d = pytest.mark.skipif(find_spec("Box2D") is None, reason="pip install eslang[gym]")


def on_cart(text: str) -> list[str]:
    """The lines that TEXT prints where there is the environment :cart."""
    return lines_of(CART + text)


def failure(text: str) -> tuple[str, ...]:
    """The cause and the arguments of the failure that TEXT ends with."""
    failed = run(text).failure
    return (str(failed.cause), *map(str, failed.arguments))


def test_without_gymnasium_the_failure_says_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "gymnasium", None)
    assert failure(CART) == (":NO-SUCH-PACKAGE", "gymnasium", "pip install 'eslang[gym]'")


def test_an_environment_that_nobody_made_is_a_failure_with_the_nearest_name() -> None:
    assert failure("(environment-step :cart 1)") == (":NO-SUCH-ENVIRONMENT", ":CART", "None")


@needs_gymnasium
class TestEnvironments:
    def test_sensors_are_facts_with_the_names_that_were_given(self) -> None:
        text = "(print (mapcar #'cdar (db-query '(sensed :cart ?sensor ?_))))"
        assert on_cart(text) == ["(:PLACE :SPEED :LEAN :SWAY)"]

    def test_sensors_without_names_are_numbered(self) -> None:
        text = """(print (make-environment "CartPole-v1" :sensors '(:place)))
                  (print (mapcar #'cdar (db-query '(sensed :cartpole-v1 ?sensor ?_))))"""
        assert lines_of(text) == [":CARTPOLE-V1", "(:PLACE 1 2 3)"]

    def test_a_step_gives_the_reward_and_changes_the_facts(self) -> None:
        text = """
            (defun place () (cdaar (db-query '(sensed :cart :place ?place))))
            (let ((before (place)))
              (print (environment-step :cart 1))
              (print (= before (place)))
              (print (length (db-query '(sensed :cart ?sensor ?value)))))"""
        assert on_cart(text) == ["1.0", "NIL", "4"]

    def test_an_episode_that_is_over_leaves_a_score(self) -> None:
        text = """
            (let ((steps 0))
              (print (db-query '(score :cart ?total)))
              (repeat :while (episode :cart :running) (incf steps) (environment-step :cart 0))
              (print (db-query '(episode :cart ?state)))
              (print (list (= steps (environment-score :cart))
                           (= steps (cdaar (db-query '(score :cart ?total)))))))"""
        assert on_cart(text) == ["NIL", "(((?STATE . :TERMINATED)))", "(T T)"]

    def test_a_reset_begins_a_new_episode_without_a_score(self) -> None:
        text = """
            (repeat :while (episode :cart :running) (environment-step :cart 0))
            (print (environment-reset :cart))
            (print (list (db-query '(episode :cart ?state)) (db-query '(score :cart ?total))
                         (environment-score :cart)))"""
        assert on_cart(text) == [":CART", "((((?STATE . :RUNNING))) NIL 0.0)"]

    def test_an_episode_that_lasts_too_long_is_truncated(self) -> None:
        text = """(make-environment "Acrobot-v1" :name :arm :max-episode-steps 5)
                  (repeat :while (episode :arm :running) (environment-step :arm 1))
                  (print (db-query '(episode :arm ?state)))"""
        assert lines_of(text) == ["(((?STATE . :TRUNCATED)))"]

    def test_a_step_after_the_end_fails(self) -> None:
        text = """(make-environment "Acrobot-v1" :name :arm :max-episode-steps 1)
                  (environment-step :arm 1) (environment-step :arm 1)"""
        assert failure(text) == (":EPISODE-OVER", ":ARM", ":TRUNCATED")

    @pytest.mark.parametrize("action", ["7", "-1", "1.0", "nil", ":left", '"1"', "'(1 2)"])
    def test_what_is_no_action_of_the_environment_is_a_failure(self, action: str) -> None:
        found = failure(f"{CART} (environment-step :cart {action})")
        assert (found[0], found[-1]) == (":NO-SUCH-ACTION", "Discrete(2)")

    @pytest.mark.parametrize("action", ["1", "-0.5", "1/2", "'(0.25)"])
    def test_continuous_actions_are_numbers_or_lists_of_them(self, action: str) -> None:
        text = f"""(make-environment "MountainCarContinuous-v0" :name :hill)
                   (print (realp (environment-step :hill {action})))"""
        assert lines_of(text) == ["T"]

    @pytest.mark.parametrize("action", ["nil", ":left", "'(0.5 0.5)", '"fast"'])
    def test_other_values_are_no_continuous_actions(self, action: str) -> None:
        text = f'(make-environment "MountainCarContinuous-v0" :name :hill) (environment-step :hill {action})'
        assert failure(text)[0] == ":NO-SUCH-ACTION"

    def test_an_observation_may_be_one_number_or_several_of_different_kinds(self) -> None:
        text = """(make-environment "FrozenLake-v1" :name :ice)
                  (print (db-query '(sensed :ice ?sensor ?value)))
                  (make-environment "Blackjack-v1" :name :cards)
                  (print (mapcar #'cdar (db-query '(sensed :cards ?sensor ?_))))"""
        assert lines_of(text) == ["(((?SENSOR . 0) (?VALUE . 0)))", "(0 1 2)"]

    def test_an_environment_that_there_is_not_is_a_failure(self) -> None:
        assert failure('(make-environment "CarPole-v1")')[:2] == (":NO-SUCH-ENVIRONMENT", "CarPole-v1")

    def test_a_misspelt_name_gets_the_nearest_one(self) -> None:
        assert failure(CART + "(environment-score :card)") == (":NO-SUCH-ENVIRONMENT", ":CARD", ":CART")

    def test_what_is_made_again_begins_anew(self) -> None:
        text = """(environment-step :cart 1)
                  (make-environment "FrozenLake-v1" :name :cart)
                  (print (list (length (db-query '(sensed :cart ?sensor ?_))) (environment-score :cart)))"""
        assert on_cart(text) == ["(1 0.0)"]

    def test_what_is_closed_is_forgotten(self) -> None:
        text = """(repeat :while (episode :cart :running) (environment-step :cart 1))
                  (print (environment-close :cart))
                  (print (db-query '(or (sensed ?_ ?_ ?_) (episode ?_ ?_) (score ?_ ?_))))"""
        assert on_cart(text) == [":CART", "NIL"]
        again = CART + "(environment-close :cart) (environment-score :cart)"
        assert failure(again)[0] == ":NO-SUCH-ENVIRONMENT"

    @pytest.mark.parametrize("name", ["'pole", '"pole"', "7", ":pole"])
    def test_a_name_may_be_of_any_kind_but_a_list(self, name: str) -> None:
        text = f"""(make-environment "CartPole-v1" :name {name} :sensors '("x" y))
                   (environment-step {name} 1)
                   (print (length (db-query '(sensed {name.strip("'")} "x" ?x))))
                   (print (length (db-query '(sensed {name.strip("'")} ?sensor ?value))))
                   (print (equal (environment-close {name}) {name}))"""
        assert lines_of(text) == ["1", "4", "T"]
        assert failure(text.replace(f":name {name}", ":name '(pole)"))[0] == ":TYPE-ERROR"

    def test_chance_comes_from_the_seed_of_the_run(self) -> None:
        text = """(make-environment "CartPole-v1" :name :cart)
                  (print (db-query '(sensed :cart ?sensor ?value)))"""
        assert lines_of(text, seed=1) == lines_of(text, seed=1) != lines_of(text, seed=2)

    def test_a_change_wakes_who_waits_for_it_and_steps_are_seen_whole(self) -> None:
        text = """
            (task-net
              (pilot (repeat :while (episode :cart :running) (environment-step :cart 1)) (yield))
              (watch (wait-until (score :cart ?total))
                     (print (db-query '(episode :cart ?state)))))"""
        assert on_cart(text) == ["(((?STATE . :TERMINATED)))"]

    def test_two_environments_are_steered_at_a_time(self) -> None:
        text = """
            (make-environment "Acrobot-v1" :name :arm :max-episode-steps 20)
            (print (do-all (repeat :while (episode :cart :running) (environment-step :cart 1))
                           (repeat :while (episode :arm :running) (environment-step :arm 1))))
            (print (db-query '(episode ?which ?state)))"""
        states = ["((?WHICH . :CART) (?STATE . :TERMINATED))", "((?WHICH . :ARM) (?STATE . :TRUNCATED))"]
        assert on_cart(text) in (["T", f"({' '.join(order)})"] for order in (states, states[::-1]))

    @pytest.mark.slow
    def test_the_blocks_of_the_page_are_one_program(self) -> None:
        blocks = re.findall(r"^```lisp\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.M | re.S)
        check_program("\n".join(blocks), PAGE.name)

    def test_a_circuit_keeps_the_pole_up_longer_than_a_fixed_action(self) -> None:
        text = """
            (do-first :while (episode :cart :running)
              ((and (sensed :cart :lean ?lean) (sensed :cart :sway ?sway) (> (+ ?lean ?sway) 0))
               (repeat (environment-step :cart 1)))
              (t (repeat (environment-step :cart 0))))
            (print (> (environment-score :cart) 150))"""
        assert on_cart(text) == ["T"]

    def test_a_choice_learns_from_the_reward_which_way_is_up(self) -> None:
        text = """
            (make-environment "MountainCarContinuous-v0" :name :hill :seed 1)
            (dotimes (trial 30)
              (do-best :learn 0.5
                (t 1 (reinforce (if (< (environment-step :hill 1) -0.05) 0 1)))
                (t 1 (reinforce (if (< (environment-step :hill 0) -0.05) 0 1)))))
            (print (mapcar (lambda (found) (> (cdar found) 0.9)) (db-query '(scs::discount ?_ ?factor))))"""
        assert sorted(lines_of(text)[0].strip("()").split()) == ["NIL", "T"]


@needs_gymnasium
@needs_box2d
@pytest.mark.slow
class TestTheLander:
    @pytest.mark.parametrize("seed", range(20))
    def test_the_plan_lands_and_scores(self, seed: int, capsys: pytest.CaptureFixture[str]) -> None:
        code = main(["run", "--clock", "virtual", "--seed", str(seed), str(LANDER)])
        printed = capsys.readouterr()
        score, landed = printed.out.splitlines()
        assert (code, landed, printed.err) == (0, "Landed.", "")
        assert int(score.removeprefix("Score: ")) >= 200

    def test_the_score_stands_in_the_trace(self, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
        trace = tmp_path / "landing.jsonl"
        main(["run", "--clock", "virtual", "--trace", str(trace), str(LANDER)])
        score = int(capsys.readouterr().out.split()[1])
        main(["trace", "--all", "--kind", "fact", str(trace)])
        told = " ".join(capsys.readouterr().out.replace("│", "").split())
        found = re.search(r"asserts \(SCORE :LANDER ([\d.]+)\)", told)
        assert found and round(float(found[1])) == score
