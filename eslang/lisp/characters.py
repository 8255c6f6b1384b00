"""Characters: their codes, kinds, cases and names (CLHS 13)."""

from __future__ import annotations

import operator
from itertools import pairwise

from eslang.base.character_names import character_name, find_character
from eslang.base.failure import type_error
from eslang.base.hints import Callable
from eslang.base.number_text import DIGITS
from eslang.base.symbols import Symbol, Value, truth
from eslang.base.text import Character, String, character
from eslang.compile.registry import function, variable
from eslang.lisp.numbers import check_integer

variable("char-code-limit", 0x110000, "Every character's code is below this.", constant=True)


def check_character(value: Value, name: str) -> str:
    """The Python text of VALUE, if it is a character; else a type error of the function NAME."""
    if value.__class__ is Character:
        char: str = value.char
        return char
    raise type_error(value, "CHARACTER", name)


def folded(char: str) -> str:
    """CHAR as the comparisons that do not mind case see it."""
    upper = char.upper()
    return upper if len(upper) == 1 else char


def has_case(char: str) -> bool:
    """True if CHAR is one of a pair of letters that differ only in case."""
    if char.isascii():
        return char.isalpha()
    lower, upper = char.lower(), char.upper()
    return len(lower) == 1 and len(upper) == 1 and lower != upper and char in (lower, upper)


class _Other(dict[str, Character]):
    """The other letter of each that has case, or the character itself; each found once."""

    def __init__(self, change: Callable[[str], str]) -> None:
        super().__init__()
        self.change = change

    def __missing__(self, char: str) -> Character:
        return self.setdefault(char, character(self.change(char) if has_case(char) else char))


_UPPER, _LOWER = _Other(str.upper), _Other(str.lower)


@function("(character designator)")
def to_character(designator: Value) -> Value:
    """Return the character that DESIGNATOR is, or is a string or symbol of."""
    if designator.__class__ is Character:
        return designator
    if designator.__class__ is String:
        text = designator.text
    elif designator is None or isinstance(designator, Symbol):
        text = "NIL" if designator is None else designator.name
    else:
        text = ""
    if len(text) != 1:
        raise type_error(designator, "CHARACTER", "character")
    return character(text)


@function("(char-code character)")
def char_code(char: Value) -> Value:
    """Return the code of CHARACTER."""
    return ord(check_character(char, "char-code"))


@function("(char-int character)")
def char_int(char: Value) -> Value:
    """Return the code of CHARACTER."""
    return ord(check_character(char, "char-int"))


@function("(code-char code)")
def code_char(code: Value) -> Value:
    """Return the character whose code is CODE; NIL if there is none."""
    if not 0 <= check_integer(code, "code-char") < 0x110000:
        raise type_error(code, "CHARACTER-CODE", "code-char")
    return character(chr(code))


@function("(char-upcase character)")
def char_upcase(char: Value) -> Value:
    """Return the upper-case letter of CHARACTER, or CHARACTER itself."""
    return _UPPER[check_character(char, "char-upcase")]


@function("(char-downcase character)")
def char_downcase(char: Value) -> Value:
    """Return the lower-case letter of CHARACTER, or CHARACTER itself."""
    return _LOWER[check_character(char, "char-downcase")]


@function("(alpha-char-p character)")
def alpha_char_p(char: Value) -> Value:
    """Return T if CHARACTER is a letter."""
    return truth(check_character(char, "alpha-char-p").isalpha())


@function("(alphanumericp character)")
def alphanumericp(char: Value) -> Value:
    """Return T if CHARACTER is a letter or a digit."""
    return truth(check_character(char, "alphanumericp").isalnum())


@function("(upper-case-p character)")
def upper_case_p(char: Value) -> Value:
    """Return T if CHARACTER is an upper-case letter that has a lower-case one."""
    text = check_character(char, "upper-case-p")
    return truth(has_case(text) and text == text.upper())


@function("(lower-case-p character)")
def lower_case_p(char: Value) -> Value:
    """Return T if CHARACTER is a lower-case letter that has an upper-case one."""
    text = check_character(char, "lower-case-p")
    return truth(has_case(text) and text == text.lower())


@function("(both-case-p character)")
def both_case_p(char: Value) -> Value:
    """Return T if CHARACTER is a letter with case."""
    return truth(has_case(check_character(char, "both-case-p")))


@function("(graphic-char-p character)")
def graphic_char_p(char: Value) -> Value:
    """Return T if CHARACTER shows as itself, as a space does."""
    return truth(check_character(char, "graphic-char-p").isprintable())


@function("(standard-char-p character)")
def standard_char_p(char: Value) -> Value:
    """Return T if CHARACTER is one of the 96 that every Lisp has."""
    text = check_character(char, "standard-char-p")
    return truth(text == "\n" or " " <= text <= "~")


def digit_weight(char: str, radix: int) -> int | None:
    """The weight of CHAR as a digit in RADIX; None if it is no such digit."""
    weight = DIGITS.find(char.upper()) if char.isascii() else -1
    if weight < 0 and char.isdecimal():
        weight = int(char)
    return weight if 0 <= weight < radix else None


def check_radix(radix: Value, name: str) -> int:
    """RADIX, if it is an integer from 2 to 36; else a type error of the function NAME."""
    if radix.__class__ is int and 2 <= radix <= 36:
        number: int = radix
        return number
    raise type_error(radix, "(INTEGER 2 36)", name)


@function("(digit-char-p character &optional (radix 10))")
def digit_char_p(char: Value, radix: Value = 10) -> Value:
    """Return the weight of CHARACTER as a digit in RADIX; NIL if it is none."""
    return digit_weight(check_character(char, "digit-char-p"), check_radix(radix, "digit-char-p"))


@function("(digit-char weight &optional (radix 10))")
def digit_char(weight: Value, radix: Value = 10) -> Value:
    """Return the digit of WEIGHT in RADIX; NIL if there is none."""
    if not 0 <= check_integer(weight, "digit-char") < check_radix(radix, "digit-char"):
        return None
    return character(DIGITS[weight])


@function("(char-name character)")
def char_name(char: Value) -> Value:
    """Return the name of CHARACTER as a string; NIL if it shows as itself."""
    name = character_name(check_character(char, "char-name"))
    return String(name) if name is not None else None


@function("(name-char name)")
def name_char(name: Value) -> Value:
    """Return the character called NAME, in any case; NIL if there is none."""
    if name.__class__ is String:
        text = name.text
    elif name.__class__ is Character:
        text = name.char
    elif name is None or isinstance(name, Symbol):
        text = "NIL" if name is None else name.name
    else:
        raise type_error(name, "STRING", "name-char")
    char = find_character(text)
    return character(char) if char is not None else None


def _register(sign: str, holds: Callable[[str, str], bool], claim: str) -> None:
    for name, view in ((f"char{sign}", str), (_INSENSITIVE[sign], folded)):
        _register_one(name, holds, view, claim if view is str else claim + ", case aside")


def _register_one(
    name: str, holds: Callable[[str, str], bool], view: Callable[[str], str], claim: str
) -> None:
    def compare(char: Value, *others: Value) -> Value:
        seen = [view(check_character(each, name)) for each in (char, *others)]
        if holds is operator.ne:
            return truth(len(set(seen)) == len(seen))
        return truth(all(holds(left, right) for left, right in pairwise(seen)))

    compare.__doc__ = f"Return T if {claim}."
    compare.__name__ = name
    function(f"({name} character &rest more-characters)")(compare)


_INSENSITIVE = {
    "=": "char-equal",
    "/=": "char-not-equal",
    "<": "char-lessp",
    ">": "char-greaterp",
    "<=": "char-not-greaterp",
    ">=": "char-not-lessp",
}
_register("=", operator.eq, "all the characters are the same")
_register("/=", operator.ne, "no two of the characters are the same")
_register("<", operator.lt, "each character comes before the next")
_register(">", operator.gt, "each character comes after the next")
_register("<=", operator.le, "no character comes after the next")
_register(">=", operator.ge, "no character comes before the next")
