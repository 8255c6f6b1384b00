"""A person at a terminal, for tests: types, and reads until something appears."""

from __future__ import annotations

import fcntl
import os
import pty
import re
import select
import struct
import subprocess
import sys
import termios
import time
from collections.abc import Sequence

from unit.tools.command import environment

# Makes the terminal the one that Ctrl-C comes from, and becomes the command.
OWN_TERMINAL = """
import fcntl, os, sys, termios
fcntl.ioctl(0, termios.TIOCSCTTY, 0)
os.execvp(sys.argv[1], sys.argv[1:])
"""
CONTROL = re.compile(
    r"\x1b\[[0-9;?]*[A-Za-z]|\x1b[()][A-Z0-9]|\x1b\][^\x07]*\x07|\x1b[=>78]|\x07|\x08|\x1b[^A-Za-z]*\Z"
)


class Terminal:
    """A command at a terminal of its own."""

    def __init__(self, command: Sequence[str], **variables: str) -> None:
        self.master, slave = pty.openpty()
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 40, 100, 0, 0))
        settings = environment(TERM="xterm", PROMPT_TOOLKIT_NO_CPR="1", **variables)
        self.running = subprocess.Popen(
            [sys.executable, "-c", OWN_TERMINAL, *command],
            stdin=slave,
            stdout=slave,
            stderr=slave,
            env=settings,
            start_new_session=True,
        )
        os.close(slave)
        self.raw = ""
        self.read_to = 0

    def __enter__(self) -> Terminal:
        return self

    def __exit__(self, *_: object) -> None:
        self.running.kill()
        self.running.wait()
        os.close(self.master)

    def type(self, text: str) -> None:
        """Press the keys of TEXT."""
        os.write(self.master, text.encode())

    def until(self, pattern: str, timeout: float = 20) -> str:
        """Read until PATTERN appears in what is new; all that is new, up to its end."""
        end = time.monotonic() + timeout
        while True:
            text = self.text[self.read_to :]
            found = re.search(pattern, text)
            if found:
                self.read_to += found.end()
                return text[: found.end()]
            if not self._more(end - time.monotonic()):
                raise AssertionError(f"waited for {pattern!r}, came {text!r}")

    @property
    def text(self) -> str:
        """All that appeared, without the control sequences."""
        return CONTROL.sub("", self.raw).replace("\r", "")

    def wait(self, timeout: float = 20) -> int:
        """The exit code, once the command has ended."""
        end = time.monotonic() + timeout
        while self._more(end - time.monotonic()):
            pass
        return self.running.wait(timeout)

    def _more(self, seconds: float) -> bool:
        """Read what comes within SECONDS; false if nothing does any more."""
        ready, _, _ = select.select([self.master], [], [], max(0, seconds))
        if not ready:
            return False
        try:
            new = os.read(self.master, 65536)
        except OSError:
            return False
        self.raw += new.decode(errors="replace")
        return bool(new)
