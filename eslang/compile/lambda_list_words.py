"""The markers of lambda lists, apart, since the library names them without parsing any."""

from __future__ import annotations

from eslang.base.symbols import Symbol

OPTIONAL, REST, BODY, KEY, AUX, ALLOW, WHOLE, ENVIRONMENT = MARKERS = tuple(
    Symbol.intern(name, "COMMON-LISP")
    for name in (
        "&OPTIONAL",
        "&REST",
        "&BODY",
        "&KEY",
        "&AUX",
        "&ALLOW-OTHER-KEYS",
        "&WHOLE",
        "&ENVIRONMENT",
    )
)
