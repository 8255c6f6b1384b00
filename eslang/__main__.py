"""`python -m eslang` is the command `esl`."""

from __future__ import annotations

import sys

from eslang.tools.cli import main

if __name__ == "__main__":
    sys.exit(main())
