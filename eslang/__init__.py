"""eslang: ESL, the Execution Support Language, with SCS."""

__version__ = "0.1.0"
