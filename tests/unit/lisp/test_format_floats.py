"""FORMAT: floats."""

from __future__ import annotations

import pytest
from forms import value_of


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~f" 3.14159)', '"3.14159"'),
        ('(format nil "~,2f" 3.14159)', '"3.14"'),
        ('(format nil "~,2f" 0.005)', '"0.01"'),
        ('(format nil "~,2f" 2.675)', '"2.67"'),
        ('(format nil "~,1f" 0.25)', '"0.3"'),
        ('(format nil "~,0f" 2.5)', '"3."'),
        ('(format nil "~6,2f" 3.14159)', '"  3.14"'),
        ('(format nil "~6f" 3.14159)', '"3.1416"'),
        ('(format nil "~3,2f" 0.5)', '".50"'),
        ('(format nil "~f" 1.0e10)', '"10000000000.0"'),
        ('(format nil "~f" 1.0e-10)', '"0.0000000001"'),
        ('(format nil "~,2f" 3)', '"3.00"'),
        ('(format nil "~,3f" 1/3)', '"0.333"'),
        ('(format nil "~@f" 1.5)', '"+1.5"'),
        ('(format nil "~5,2,2f" 1.2345)', '"123.45"'),
        ('(format nil "~5,2,,\'*f" 12345.678)', '"*****"'),
        ('(format nil "~10,3,,,\'xf" 1.5)', '"xxxxx1.500"'),
        ('(format nil "~f" "ab")', '"ab"'),
        ('(format nil "~,2f" -0.001)', '"-0.00"'),
    ],
)
def test_a_fixed_point(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~e" 3.14159)', '"3.14159e+0"'),
        ('(format nil "~e" 0.0)', '"0.0e+0"'),
        ('(format nil "~,2e" 12345.678)', '"1.23e+4"'),
        ('(format nil "~10,2e" 12345.678)', '"   1.23e+4"'),
        ('(format nil "~10,2,2e" 12345.678)', '"  1.23e+04"'),
        ('(format nil "~,,,2e" 12345.678)', '"12.345678e+3"'),
        ('(format nil "~,3,,0e" 12345.678)', '"0.123e+5"'),
        ('(format nil "~,3,,-1e" 12345.678)', '"0.012e+6"'),
        ('(format nil "~,3,,2e" 12345.678)', '"12.35e+3"'),
        ("(format nil \"~12,3,2,,'*,'x,'de\" 1.5)", '"xxx1.500d+00"'),
        ('(format nil "~5,2,,,\'*e" 12345.678)', '"*****"'),
        ('(format nil "~,1e" 9.99)', '"1.0e+1"'),
        ('(format nil "~@e" 2.0)', '"+2.0e+0"'),
    ],
)
def test_an_exponent(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~g|" 3.14159)', '"3.14159    |"'),
        ('(format nil "~g|" 0.0)', '"0.    |"'),
        ('(format nil "~g|" 100.0)', '"100.    |"'),
        ('(format nil "~10,3g|" 3.14159)', '"  3.14    |"'),
        ('(format nil "~10,3g|" 1.0e10)', '" 1.000e+10|"'),
        ('(format nil "~,3g" 0.001)', '"1.000e-3"'),
    ],
)
def test_whichever_shows_the_number_well(form: str, value: str) -> None:
    assert value_of(form) == value


@pytest.mark.parametrize(
    ("form", "value"),
    [
        ('(format nil "~$" 3.14159)', '"3.14"'),
        ('(format nil "~$" 3)', '"3.00"'),
        ('(format nil "~,4$" 3.14159)', '"0003.14"'),
        ('(format nil "~3,4,10,\'*$" -3.14159)', '"*-0003.142"'),
        ('(format nil "~2,2,10:$" -3.1)', '"-    03.10"'),
        ('(format nil "~@$" 3.1)', '"+3.10"'),
        ('(format nil "~$" "ab")', '"ab"'),
    ],
)
def test_money(form: str, value: str) -> None:
    assert value_of(form) == value
