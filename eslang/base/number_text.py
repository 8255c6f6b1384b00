"""Numbers as Lisp writes them: integers in any base, floats, ratios.

The printer and FORMAT stand on this. Floats are all doubles and print without
a marker, as Common Lisp prints its default format: plain between 1/1000 and
10,000,000, else with an exponent.
"""

from __future__ import annotations

from eslang.base.symbols import Value

DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ"
_CHUNK = 1000  # digits that Python converts at once without asking for permission
_PYTHON_CODES = {2: "b", 8: "o", 16: "X"}
_RADIX_MARKS = {2: "#b", 8: "#o", 16: "#x"}


def integer_text(number: int, base: int = 10) -> str:
    """NUMBER written in BASE, with a minus sign if it is negative."""
    code = _PYTHON_CODES.get(base)
    if code is not None:
        return format(number, code)
    if number < 0:
        return "-" + integer_text(-number, base)
    if base == 10 and number.bit_length() < 3 * _CHUNK:
        return str(number)
    return _small_text(number, base) if number < base**_CHUNK else _large_text(number, base)


def _small_text(number: int, base: int) -> str:
    if base == 10:
        return str(number)
    digits = []
    while number:
        number, digit = divmod(number, base)
        digits.append(DIGITS[digit])
    return "".join(reversed(digits)) or "0"


def _large_text(number: int, base: int) -> str:
    powers = [base**_CHUNK]
    while powers[-1] <= number:
        powers.append(powers[-1] ** 2)
    pieces = [number]
    for position in range(len(powers) - 1, -1, -1):  # halve each piece, most significant first
        halves: list[int] = []
        for piece in pieces:
            halves.extend(divmod(piece, powers[position]))
        pieces = halves
    text = "".join(_small_text(piece, base).rjust(_CHUNK, "0") for piece in pieces)
    return text.lstrip("0")


def rational_text(number: Value, base: int = 10, radix: bool = False) -> str:
    """An integer or ratio in BASE; with RADIX marked as the reader wants it (`#x1F`, `10.`)."""
    if number.__class__ is int:
        text = integer_text(number, base)
        if radix and base == 10:
            return text + "."
    else:
        text = f"{integer_text(number.numerator, base)}/{integer_text(number.denominator, base)}"
    return (_RADIX_MARKS.get(base) or f"#{base}r") + text if radix else text


def decimal_digits(number: float) -> tuple[str, int]:
    """The shortest digits that mean NUMBER (finite, sign ignored), and where their point stands.

    (digits, point): the value is 0.DIGITS times ten to the POINT; zero gives ("0", 1).
    """
    mantissa, _, exponent = repr(abs(number)).partition("e")
    whole, _, fraction = mantissa.partition(".")
    digits = (whole + fraction).lstrip("0")
    point = len(whole) + int(exponent or 0) - (len(whole + fraction) - len(digits))
    return (digits.rstrip("0"), point) if digits else ("0", 1)


def float_text(number: float) -> str:
    """NUMBER as the printer shows it: 0.5, 1.0e10; what is no number in an unreadable form."""
    if number != number or number in (float("inf"), float("-inf")):
        return f"#<FLOAT {'nan' if number != number else 'infinity' if number > 0 else '-infinity'}>"
    size = abs(number)
    if size == 0 or 1e-3 <= size < 1e7:
        return repr(number)
    digits, point = decimal_digits(number)
    sign = "-" if number < 0 else ""
    return f"{sign}{digits[0]}.{digits[1:] or '0'}e{point - 1}"


def is_number_token(name: str) -> bool:
    """True if the reader would take NAME for a number and not for a symbol."""
    body = name[1:] if name[:1] in ("+", "-") else name
    if not body.isascii() or not (body[:1].isdigit() or body[:1] == "."):
        return False
    numerator, slash, denominator = body.partition("/")
    if slash:
        return numerator.isdigit() and denominator.isdigit()
    for marker in "EDFSL":
        mantissa, found, exponent = body.upper().partition(marker)
        if found:
            digits = exponent[1:] if exponent[:1] in ("+", "-") else exponent
            return digits.isdigit() and any(c.isdigit() for c in mantissa) and _is_decimal(mantissa)
    return any(c.isdigit() for c in body) and _is_decimal(body)


def _is_decimal(text: str) -> bool:
    whole, _, fraction = text.partition(".")
    return (whole.isdigit() or not whole) and (fraction.isdigit() or not fraction)


def digits_value(digits: str, base: int = 10) -> int:
    """The integer that DIGITS, all valid in BASE, stand for; there may be any number of them."""
    if len(digits) <= _CHUNK:
        return int(digits, base)
    middle = len(digits) // 2
    scale: int = base ** (len(digits) - middle)
    return digits_value(digits[:middle], base) * scale + digits_value(digits[middle:], base)
