"""The suite's own files are tests too: plans, transcripts, and the blocks of the docs (support.py)."""

from __future__ import annotations

import pytest

from support import Collector


def pytest_configure(config: pytest.Config) -> None:
    """Collect for every folder, not for tests/ alone, as a conftest by itself would."""
    config.pluginmanager.register(Collector(), "eslang-collector")
