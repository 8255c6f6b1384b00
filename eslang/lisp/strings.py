"""Strings: comparison, case, trimming, elements, integers in them (CLHS 16).

Where a string is wanted to look at, a symbol or a character will do; where it
is changed, only a string.
"""

from __future__ import annotations

import operator

from eslang.base.arguments import take_keys
from eslang.base.failure import Failure, index_out_of_range, simple_error, type_error
from eslang.base.hints import Callable
from eslang.base.lists import Cons, items
from eslang.base.many import Values
from eslang.base.number_text import digits_value
from eslang.base.symbols import Symbol, Value, truth
from eslang.base.text import Character, String, Vector, character
from eslang.compile.registry import function
from eslang.lisp.characters import check_character, check_radix, digit_weight, folded, has_case
from eslang.lisp.numbers import check_integer

_LONGEST = 1 << 31  # a string beyond this asks for more memory than there is


def text_of(designator: Value, name: str) -> str:
    """The text that DESIGNATOR, a string, symbol or character, stands for."""
    text: str
    if designator.__class__ is String:
        text = designator.text
    elif designator is None:
        text = "NIL"
    elif isinstance(designator, Symbol):
        text = designator.name
    elif designator.__class__ is Character:
        text = designator.char
    else:
        raise type_error(designator, "STRING", name)
    return text


def check_string(value: Value, name: str) -> String:
    """VALUE, if it is a string; else a type error of the function NAME."""
    if value.__class__ is String:
        string: String = value
        return string
    raise type_error(value, "STRING", name)


def bounds(string: Value, length: int, start: Value, end: Value, name: str) -> tuple[int, int]:
    """START and END as two places in a string of LENGTH; NIL means its beginning, its end."""
    first = 0 if start is None else check_integer(start, name)
    last = length if end is None else check_integer(end, name)
    if not 0 <= last <= length:
        raise index_out_of_range(string, last)
    if not 0 <= first <= last:
        raise index_out_of_range(string, first)
    return first, last


def _set_text(string: String, text: str) -> String:
    string.text = text
    return string


@function("(string designator)")
def string(designator: Value) -> Value:
    """Return DESIGNATOR, or the string that a symbol or character stands for."""
    return designator if designator.__class__ is String else String(text_of(designator, "string"))


@function("(make-string size &key initial-element element-type)")
def make_string(size: Value, *options: Value) -> Value:
    """Return a new string of SIZE characters, spaces unless told otherwise."""
    element, _ = take_keys(options, ("INITIAL-ELEMENT", "ELEMENT-TYPE"))
    if not 0 <= check_integer(size, "make-string") <= _LONGEST:
        raise type_error(size, "ARRAY-INDEX", "make-string")
    return String((" " if element is None else check_character(element, "make-string")) * size)


def _char(string: Value, index: Value, name: str) -> Value:
    text = check_string(string, name).text
    if not 0 <= check_integer(index, name) < len(text):
        raise index_out_of_range(string, index)
    return character(text[index])


def _set_char(string: Value, index: Value, char: Value, name: str) -> Value:
    text = check_string(string, name).text
    if index.__class__ is not int or not 0 <= index < len(text):
        check_integer(index, name)
        raise index_out_of_range(string, index)
    string.text = text[:index] + check_character(char, name) + text[index + 1 :]
    return char


@function("(char string index)")
def char(string: Value, index: Value) -> Value:
    """Return the character of STRING at INDEX.

    Fails: :index-out-of-range.
    """
    return _char(string, index, "char")


@function("(schar string index)")
def schar(string: Value, index: Value) -> Value:
    """Return the character of STRING at INDEX.

    Fails: :index-out-of-range.
    """
    return _char(string, index, "schar")


@function("(%set-char string index character)")
def set_char(string: Value, index: Value, char: Value) -> Value:
    """Make CHARACTER the one of STRING at INDEX, for (setf char)."""
    return _set_char(string, index, char, "char")


@function("(%set-schar string index character)")
def set_schar(string: Value, index: Value, char: Value) -> Value:
    """Make CHARACTER the one of STRING at INDEX, for (setf schar)."""
    return _set_char(string, index, char, "schar")


def _upcase(text: str) -> str:
    return text.upper() if text.isascii() else "".join(c.upper() if has_case(c) else c for c in text)


def _downcase(text: str) -> str:
    return text.lower() if text.isascii() else "".join(c.lower() if has_case(c) else c for c in text)


def capitalize(text: str) -> str:
    """TEXT with the first letter of every word in upper case, the others in lower case."""
    pieces, inside = [], False
    for char in text:
        pieces.append(_downcase(char) if inside else _upcase(char))
        inside = char.isalnum()
    return "".join(pieces)


def _register_case(name: str, change: Callable[[str], str], how: str) -> None:
    def part(text: str, string: Value, options: tuple[Value, ...]) -> str:
        start, end = take_keys(options, ("START", "END"))
        first, last = bounds(string, len(text), start, end, name)
        return text[:first] + change(text[first:last]) + text[last:]

    def fresh(string: Value, *options: Value) -> Value:
        return String(part(text_of(string, name), string, options))

    def in_place(string: Value, *options: Value) -> Value:
        return _set_text(string, part(check_string(string, "n" + name).text, string, options))

    fresh.__name__, in_place.__name__ = name, "n" + name
    fresh.__doc__ = f"Return STRING, or the part from START to END, {how}."
    in_place.__doc__ = f"Change STRING, or the part from START to END, to be {how}."
    function(f"({name} string &key start end)")(fresh)
    function(f"(n{name} string &key start end)")(in_place)


_register_case("string-upcase", _upcase, "in upper case")
_register_case("string-downcase", _downcase, "in lower case")
_register_case("string-capitalize", capitalize, "capitalized")


def _bag(characters: Value, name: str) -> str:
    if characters.__class__ is String:
        text: str = characters.text
        return text
    if characters is None or characters.__class__ is Cons:
        elements = items(characters)
    elif characters.__class__ is Vector:
        elements = characters.active()
    else:
        raise type_error(characters, "SEQUENCE", name)
    return "".join(check_character(element, name) for element in elements)


def _trimmed(characters: Value, string: Value, name: str, left: bool, right: bool) -> Value:
    bag, text = _bag(characters, name), text_of(string, name)
    if bag and left:
        text = text.lstrip(bag)
    if bag and right:
        text = text.rstrip(bag)
    return String(text)


@function("(string-trim character-bag string)")
def string_trim(characters: Value, string: Value) -> Value:
    """Return STRING without the characters of CHARACTER-BAG at its ends."""
    return _trimmed(characters, string, "string-trim", True, True)


@function("(string-left-trim character-bag string)")
def string_left_trim(characters: Value, string: Value) -> Value:
    """Return STRING without the characters of CHARACTER-BAG at its beginning."""
    return _trimmed(characters, string, "string-left-trim", True, False)


@function("(string-right-trim character-bag string)")
def string_right_trim(characters: Value, string: Value) -> Value:
    """Return STRING without the characters of CHARACTER-BAG at its end."""
    return _trimmed(characters, string, "string-right-trim", False, True)


_COMPARISONS = {
    "=": ("string=", "string-equal", operator.eq, "are the same"),
    "/=": ("string/=", "string-not-equal", operator.ne, "differ"),
    "<": ("string<", "string-lessp", operator.lt, "are in ascending order"),
    ">": ("string>", "string-greaterp", operator.gt, "are in descending order"),
    "<=": ("string<=", "string-not-greaterp", operator.le, "are not in descending order"),
    ">=": ("string>=", "string-not-lessp", operator.ge, "are not in ascending order"),
}


def fold(text: str) -> str:
    """TEXT as the comparisons that do not mind case see it."""
    return text.upper() if text.isascii() else "".join(folded(char) for char in text)


def _parts(one: Value, other: Value, options: tuple[Value, ...], name: str) -> tuple[str, str, int]:
    """The two texts to compare, and where the first begins in its string."""
    left, right = text_of(one, name), text_of(other, name)
    if not options:
        return left, right, 0
    start1, end1, start2, end2 = take_keys(options, ("START1", "END1", "START2", "END2"))
    first, last = bounds(one, len(left), start1, end1, name)
    other_first, other_last = bounds(other, len(right), start2, end2, name)
    return left[first:last], right[other_first:other_last], first


def _difference(left: str, right: str) -> int:
    for place, (a, b) in enumerate(zip(left, right, strict=False)):
        if a != b:
            return place
    return min(len(left), len(right))


def _register_comparison(
    name: str, holds: Callable[[str, str], bool], view: Callable[[str], str], claim: str
) -> None:
    def compare(string1: Value, string2: Value, *options: Value) -> Value:
        left, right, first = _parts(string1, string2, options, name)
        left, right = view(left), view(right)
        if holds is operator.eq:
            return truth(left == right)
        return first + _difference(left, right) if holds(left, right) else None

    compare.__name__ = name
    returns = "" if holds is operator.eq else "\n\n    Returns: the first place where they differ, or NIL."
    compare.__doc__ = f"Tell if STRING1 and STRING2 {claim}.{returns}"
    function(f"({name} string1 string2 &key start1 end1 start2 end2)")(compare)


for _exact, _folded, _holds, _claim in _COMPARISONS.values():
    _register_comparison(_exact, _holds, str, _claim)
    _register_comparison(_folded, _holds, fold, _claim + ", case aside")


def _no_integer(string: Value) -> Failure:
    return simple_error("PARSE-INTEGER: not an integer", string, condition="PARSE-ERROR")


def _parsed(string: Value, options: tuple[Value, ...]) -> tuple[Value, int]:
    """The integer that STRING holds, and the place behind it."""
    text = check_string(string, "parse-integer").text
    start, end, radix, junk_allowed = take_keys(options, ("START", "END", "RADIX", "JUNK-ALLOWED"))
    base = 10 if radix is None else check_radix(radix, "parse-integer")
    place, last = bounds(string, len(text), start, end, "parse-integer")
    while place < last and text[place].isspace():
        place += 1
    negative = place < last and text[place] == "-"
    if place < last and text[place] in "+-":
        place += 1
    first = place
    while place < last and digit_weight(text[place], base) is not None:
        place += 1
    digits = text[first:place]
    if junk_allowed is None:
        if not digits or text[place:last].strip():
            raise _no_integer(string)
        place = last
    if not digits:
        return None, place
    number = digits_value(digits, base)
    return (-number if negative else number), place


def _parse_integer_many(string: Value, *options: Value) -> Value:
    return Values(_parsed(string, options))


@function("(parse-integer string &key start end radix junk-allowed)", many=_parse_integer_many)
def parse_integer(string: Value, *options: Value) -> Value:
    """Return the integer that STRING holds, in RADIX (10 unless given).

    White space around it is skipped. Under JUNK-ALLOWED anything may follow,
    and NIL is the answer if there is no integer.
    Returns: the integer and, as second value, the place behind it.
    Fails:   :error if STRING holds anything else.
    """
    return _parsed(string, options)[0]
