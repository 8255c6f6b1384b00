"""What one token means."""

from __future__ import annotations

from fractions import Fraction

import pytest

from eslang.base.resolve import NotExternal, UnknownPackage
from eslang.base.symbols import Symbol
from eslang.reader.atoms import (
    Unreadable,
    read_character,
    read_radix,
    read_string,
    read_token,
    read_uninterned,
    split_symbol,
)


def anywhere(package: str | None, name: str, external_only: bool) -> Symbol:
    """Every name is a symbol, in a package that tells how it was asked for."""
    return Symbol.intern(name, f"{package or 'HERE'}{':' if external_only else ''}")


@pytest.mark.parametrize(
    ("token", "value"),
    [
        ("5", 5),
        ("+5", 5),
        ("-5", -5),
        ("5.", 5),
        ("007", 7),
        ("1.5", 1.5),
        (".5", 0.5),
        ("-.5", -0.5),
        ("1e3", 1000.0),
        ("1E-3", 0.001),
        ("1.e2", 100.0),
        ("1.5d0", 1.5),
        ("1f0", 1.0),
        ("1s0", 1.0),
        ("1L0", 1.0),
        ("-0.0", -0.0),
        ("0e999", 0.0),
        ("1/2", Fraction(1, 2)),
        ("-6/4", Fraction(-3, 2)),
        ("4/2", 2),
    ],
)
def test_numbers(token, value):
    found = read_token(token, anywhere)
    assert found == value
    assert isinstance(found, type(value))


def test_an_integer_may_be_of_any_size():
    assert read_token("-" + "9" * 6000, anywhere) + 10**6000 == 1


@pytest.mark.parametrize(
    "token", ["1+", "+", "-", "1-", "+.", "1/", "/2", "1e", "e5", ".e5", "1.5.2", "²", "5x"]
)
def test_what_only_resembles_a_number_is_a_symbol(token):
    found = read_token(token, anywhere)
    assert isinstance(found, Symbol)
    assert found.name == token.upper()


@pytest.mark.parametrize(
    ("token", "parts"),
    [
        ("foo", (None, "FOO", False)),
        ("Grüße", (None, "GRÜßE", False)),
        ("|foo|", (None, "foo", False)),
        ("f|o|o", (None, "FoO", False)),
        ("\\foo", (None, "fOO", False)),
        ("||", (None, "", False)),
        ("|a\\|b|", (None, "a|b", False)),
        ("|a:b|", (None, "a:b", False)),
        ("a\\:b", (None, "A:B", False)),
        ("\\.", (None, ".", False)),
        (":foo", ("KEYWORD", "FOO", False)),
        (":|foo bar|", ("KEYWORD", "foo bar", False)),
        ("p:foo", ("P", "FOO", True)),
        ("p::foo", ("P", "FOO", False)),
        ("|p|:foo", ("p", "FOO", True)),
        ("a#b", (None, "A#B", False)),
    ],
)
def test_names(token, parts):
    assert split_symbol(token) == parts


@pytest.mark.parametrize("token", [":", "::", "a:", "a::", "::a", "a:b:c", "a:::b", "..", "..."])
def test_bad_names(token):
    with pytest.raises(Unreadable) as caught:
        split_symbol(token)
    assert caught.value.name == "bad-symbol"


@pytest.mark.parametrize(
    ("token", "name"),
    [("1.0e400", "number-out-of-range"), ("1e-400", "number-out-of-range"), ("1/0", "bad-number")],
)
def test_numbers_that_are_none(token, name):
    with pytest.raises(Unreadable) as caught:
        read_token(token, anywhere)
    assert caught.value.name == name


@pytest.mark.parametrize(
    ("token", "value"),
    [
        ("#xff", 255),
        ("#X-FF", -255),
        ("#b101", 5),
        ("#o17", 15),
        ("#x1/2", Fraction(1, 2)),
        ("#b-110/10", -3),
        ("#36rZz", 1295),
        ("#3R21", 7),
    ],
)
def test_other_bases(token, value):
    assert read_radix(token) == value


@pytest.mark.parametrize(
    "token", ["#xg", "#b2", "#x1.5", "#x1/", "#x/1", "#x1/0", "#1r0", "#37r0", "#x+", "#x1_0"]
)
def test_wrong_digits(token):
    with pytest.raises(Unreadable) as caught:
        read_radix(token)
    assert caught.value.name == "bad-number"


@pytest.mark.parametrize(
    ("token", "char"),
    [
        ("#\\a", "a"),
        ("#\\A", "A"),
        ("#\\(", "("),
        ("#\\\\", "\\"),
        ("#\\Space", " "),
        ("#\\newline", "\n"),
        ("#\\LINEFEED", "\n"),
        ("#\\Tab", "\t"),
        ("#\\Page", "\f"),
        ("#\\Rubout", "\x7f"),
        ("#\\Return", "\r"),
        ("#\\Backspace", "\b"),
        ("#\\Nul", "\0"),
        ("#\\é", "é"),
    ],
)
def test_characters(token, char):
    assert read_character(token).char == char


def test_an_unknown_character_has_its_nearest_name():
    with pytest.raises(Unreadable) as caught:
        read_character("#\\Newlin")
    assert caught.value.hint == "write `#\\Newline`"


def test_strings():
    assert read_string('"a\\"b\\\\c\\d\n"').text == 'a"b\\cd\n'
    assert read_string('""') is not read_string('""')


def test_uninterned_symbols_are_each_their_own():
    assert read_uninterned("#:a").name == "A"
    assert read_uninterned("#:a") is not read_uninterned("#:a")
    for token in ("#:a:b", "#::a", "#:a:"):
        with pytest.raises(Unreadable):
            read_uninterned(token)


def test_an_unknown_package_has_its_nearest_name():
    def nowhere(package, name, external_only):
        raise UnknownPackage(package, ["COMMON-LISP", "ESL-USER"])

    with pytest.raises(Unreadable) as caught:
        read_token("esl-usr:x", nowhere)
    assert (caught.value.message, caught.value.hint) == (
        "there is no package `esl-usr`",
        "write `esl-user:x`",
    )


@pytest.mark.parametrize(
    ("present", "message", "hint"),
    [
        (True, "`retrie` is not external in the package `esl`", "write `esl::retrie`"),
        (False, "the package `esl` has no symbol `retrie`", "write `esl:retries`"),
    ],
)
def test_a_symbol_that_is_not_external(present, message, hint):
    def inside(package, name, external_only):
        raise NotExternal(package, name, present, ["RETRIES"])

    with pytest.raises(Unreadable) as caught:
        read_token("esl:retrie", inside)
    assert (caught.value.message, caught.value.hint) == (message, hint)
