"""The suite's own files are tests too: plans, transcripts, and the blocks of the docs (support.py)."""

from __future__ import annotations

import os

import pytest
from hypothesis import settings

from support import Collector

# No law depends on how fast the machine is; where the suite is a judge, it judges the same way each time.
settings.register_profile("suite", deadline=None, derandomize="CI" in os.environ)
settings.load_profile("suite")


def pytest_configure(config: pytest.Config) -> None:
    """Collect for every folder, not for tests/ alone, as a conftest by itself would."""
    config.pluginmanager.register(Collector(), "eslang-collector")
