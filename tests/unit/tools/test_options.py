"""The words of the command line."""

from __future__ import annotations

import pytest

from eslang.tools.options import COMMANDS, Usage, choose, help_text, overview


def test_options_and_words_may_be_mixed() -> None:
    chosen = choose(COMMANDS["run"], ["a.esl", "--seed", "3", "-q", "--clock=virtual", "-"])
    assert chosen.words == ["a.esl", "-"]
    assert chosen.value("seed") == "3"
    assert chosen.value("clock") == "virtual"
    assert chosen.has("quiet")
    assert not chosen.has("shuffle")


def test_a_repeated_option_keeps_all_its_values_and_the_last_counts() -> None:
    chosen = choose(COMMANDS["run"], ["-e", "(a)", "-e", "-5", "--seed", "1", "--seed=2"])
    assert chosen.all("e") == ["(a)", "-5"]
    assert chosen.value("seed") == "2"


def test_behind_two_dashes_all_are_words() -> None:
    assert choose(COMMANDS["run"], ["--", "-q", "--seed"]).words == ["-q", "--seed"]


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["--nonsense"], "no option `--nonsense`"),
        (["-x"], "no option `-x`"),
        (["--seed"], "`--seed` needs a value: `--seed N`"),
        (["--quiet=yes"], "`--quiet` takes no value"),
    ],
)
def test_wrong_options_are_refused(words: list[str], complaint: str) -> None:
    with pytest.raises(Usage, match=complaint):
        choose(COMMANDS["run"], words)


def test_every_help_text_fits_a_terminal_and_names_all_options() -> None:
    for command in COMMANDS.values():
        text = help_text(command)
        assert all(len(line) <= 110 for line in text.split("\n"))
        assert all(name in text for option in command.options for name in option.names)
        assert command.name in overview()
