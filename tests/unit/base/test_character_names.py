"""The names of characters."""

from __future__ import annotations

import pytest

from eslang.base.character_names import character_name, find_character


@pytest.mark.parametrize(
    ("char", "name"), [(" ", "Space"), ("\n", "Newline"), ("\x7f", "Rubout"), ("\x01", "U+0001")]
)
def test_what_cannot_be_shown_has_a_name_that_is_found(char: str, name: str) -> None:
    assert character_name(char) == name
    assert find_character(name) == char
    assert find_character(name.lower()) == char


def test_what_can_be_shown_has_no_name() -> None:
    assert character_name("a") is None
    assert character_name("é") is None


def test_other_names_are_found() -> None:
    assert find_character("linefeed") == "\n"
    assert find_character("U0041") == "A"
    assert find_character("nosuch") is None
    assert find_character("U+FFFFFFFF") is None
