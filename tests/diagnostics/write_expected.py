"""Writes what is now said of each program beside it: python tests/diagnostics/write_expected.py [NAME...].

What it writes is to be read before it is committed: a golden file is a promise
of good words, not a record of whatever came.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def main(names: list[str]) -> None:
    """Write the expectations of the programs NAMES, or of all; show those that have changed."""
    from diagnostics.test_diagnostics import PROGRAMS, said_of

    for path in PROGRAMS:
        if not names or path.stem in names:
            os.chdir(path.parent)
            expected, text = path.with_suffix(".expected"), said_of(path)[0]
            if not expected.exists() or expected.read_text(encoding="utf-8") != text:
                expected.write_text(text, encoding="utf-8")
                sys.stdout.write(f"{text}\n")


if __name__ == "__main__":
    sys.path[:0] = [str(ROOT), str(ROOT / "tests")]
    main(sys.argv[1:])
