"""Numbers in words and in Roman figures, for ~R (CLHS 22.3.2.1)."""

from __future__ import annotations


def _words(text: str) -> list[str]:
    return text.split()


_ONES = _words(
    "zero one two three four five six seven eight nine ten eleven twelve thirteen fourteen "
    "fifteen sixteen seventeen eighteen nineteen"
)
_TENS = ["", "", *_words("twenty thirty forty fifty sixty seventy eighty ninety")]
_POWERS = [
    "",
    *_words(
        "thousand million billion trillion quadrillion quintillion sextillion septillion octillion "
        "nonillion decillion undecillion duodecillion tredecillion quattuordecillion quindecillion "
        "sexdecillion septendecillion octodecillion novemdecillion vigintillion"
    ),
]
_ORDINALS = {
    "one": "first",
    "two": "second",
    "three": "third",
    "five": "fifth",
    "eight": "eighth",
    "nine": "ninth",
    "twelve": "twelfth",
}
LARGEST_IN_WORDS = 1000 ** len(_POWERS) - 1

_ROMAN = _words("M1000 CM900 D500 CD400 C100 XC90 L50 XL40 X10 IX9 V5 IV4 I1")
_OLD_ROMAN = _words("M1000 D500 C100 L50 X10 V5 I1")


def cardinal(number: int) -> str:
    """NUMBER, not beyond LARGEST_IN_WORDS, in English words."""
    if number < 0:
        return "negative " + cardinal(-number)
    if number == 0:
        return _ONES[0]
    groups = []
    for power in _POWERS:
        number, group = divmod(number, 1000)
        if group:
            groups.append(f"{_below_thousand(group)} {power}".rstrip())
    return " ".join(reversed(groups))


def _below_thousand(number: int) -> str:
    hundreds, rest = divmod(number, 100)
    words = [f"{_ONES[hundreds]} hundred"] if hundreds else []
    if rest >= 20:
        tens, ones = divmod(rest, 10)
        words.append(_TENS[tens] + (f"-{_ONES[ones]}" if ones else ""))
    elif rest:
        words.append(_ONES[rest])
    return " ".join(words)


def ordinal(number: int) -> str:
    """The place of NUMBER in a row, in English words."""
    words = cardinal(number)
    cut = max(words.rfind(" "), words.rfind("-")) + 1
    last = words[cut:]
    if last in _ORDINALS:
        return words[:cut] + _ORDINALS[last]
    return words[:-1] + "ieth" if last.endswith("y") else words + "th"


def roman(number: int, old: bool) -> str:
    """NUMBER, above zero, in Roman figures; OLD ones write four as IIII."""
    figures = []
    for pair in _OLD_ROMAN if old else _ROMAN:
        figure = pair.rstrip("0123456789")
        count, number = divmod(number, int(pair[len(figure) :]))
        figures.append(figure * count)
    return "".join(figures)
