"""What time it is, on the clock of the interpreter.

On a virtual clock all of it is virtual, so that a run can be repeated: it
begins at the first moment of the year 2000.
"""

from __future__ import annotations

from eslang.base.running import running
from eslang.base.symbols import Value
from eslang.compile.registry import function, variable
from eslang.runtime.clock import wall_time

UNITS = 1_000_000  # in a second
MILLENNIUM = 3_155_673_600  # seconds from the beginning of 1900 to that of 2000
EPOCH = 2_208_988_800  # and to that of 1970

variable(
    "internal-time-units-per-second", UNITS, "How many units of internal time a second has.", constant=True
)


def elapsed() -> float:
    """Seconds since the interpreter began; whoever asks reads what changes by itself."""
    session = running.session
    session.touched += 1
    seconds: float = session.clock.now()
    return seconds


@function("(get-internal-real-time)")
def get_internal_real_time() -> Value:
    """Return the time since the interpreter began, in internal units."""
    return round(elapsed() * UNITS)


@function("(get-internal-run-time)")
def get_internal_run_time() -> Value:
    """Return the time since the interpreter began, in internal units."""
    return round(elapsed() * UNITS)


@function("(get-universal-time)")
def get_universal_time() -> Value:
    """Return the time in seconds since the beginning of 1900, in Greenwich."""
    seconds = elapsed()
    if running.session.clock.is_virtual:
        return MILLENNIUM + int(seconds)
    return EPOCH + int(wall_time())
