"""FORMAT: integers."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~d ~b ~o ~x" 10 10 10 255)', '"10 1010 12 FF"'),
        ('(format nil "~3r ~36r" 10 35)', '"101 Z"'),
        ('(format nil "~d" 1.5)', '"1.5"'),
        ('(format nil "~x" "a")', '"a"'),
        ('(format nil "~40r" 1)', "failure :TYPE-ERROR"),
    ],
)
def test_bases(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~5d|" 42)', '"   42|"'),
        ('(format nil "~5,\'0d" -42)', '"00-42"'),
        ('(format nil "~:d" 1234567)', '"1,234,567"'),
        ('(format nil "~,,\'.,4:d" 123456789)', '"1.2345.6789"'),
        ('(format nil "~@d" 5)', '"+5"'),
        ('(format nil "~12,\'*,,:@d" 123456)', '"****+123,456"'),
        ('(format nil "~3,5r" 10)', '"  101"'),
    ],
)
def test_layout(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~r" 0)', '"zero"'),
        (
            '(format nil "~r" 1234567)',
            '"one million two hundred thirty-four thousand five hundred sixty-seven"',
        ),
        ('(format nil "~r" -5)', '"negative five"'),
        ('(format nil "~r" 110)', '"one hundred ten"'),
        ('(format nil "~:r" 21)', '"twenty-first"'),
        ('(format nil "~:r" 12)', '"twelfth"'),
        ('(format nil "~:r" 1000000)', '"one millionth"'),
        ('(format nil "~:r" 0)', '"zeroth"'),
        ('(format nil "~r" "x")', "failure :TYPE-ERROR"),
        ('(format nil "~r" (expt 10 70))', "failure :ERROR"),
    ],
)
def test_words(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~@r" 1999)', '"MCMXCIX"'),
        ('(format nil "~:@r" 4)', '"IIII"'),
        ('(format nil "~@r" 4)', '"IV"'),
        ('(format nil "~@r" 0)', "failure :ERROR"),
        ('(format nil "~@r" 4000)', "failure :ERROR"),
    ],
)
def test_roman_figures(form: str, value: str) -> None:
    assert value_of(form) == value
