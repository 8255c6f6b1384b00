"""Texts: how the forms of a file, a string or the library are loaded.

A file is taken from the cache of compiled code if it was compiled before under
the same circumstances; else it is read, compiled and run form by form, and
kept. What was loaded so far, and in which order, is part of the circumstances.
"""

from __future__ import annotations

import os
from types import FunctionType

from eslang.base.decoding import decode, file_bytes
from eslang.base.hints import Any, Callable
from eslang.base.spans import Source
from eslang.base.symbols import Value
from eslang.compile import cache
from eslang.runtime.failures import run_apart

Run = Callable[[FunctionType], Value]


class Texts:
    """Loads texts into one interpreter."""

    def __init__(self, session: Any) -> None:
        self.session = session
        self.circumstances = ""  # a digest of all that was loaded or evaluated before

    def note(self, text: str) -> None:
        """Remember that TEXT was evaluated: what is compiled later may depend on it."""
        self.circumstances = cache.digest(self.circumstances, text)

    def run(self, source: Source) -> Value:
        """Read, compile and run the forms of a source; the value of the last."""
        self.note(source.text)
        return self._compile(source)[1]

    def load(self, source: Source, run: Run = run_apart) -> None:
        """Load a file: from the cache, if it is there. RUN runs each form, as a task unless given."""
        key = cache.digest(self.circumstances, source.name, source.text, self.session.image.package.name)
        self.note(source.text)
        if self._run_kept(key, run):
            return
        before = self.circumstances
        compiler, _ = self._compile(source, run)
        alone = self.circumstances == before  # it loaded nothing else, whose macros it might use
        written = cache.write_down(compiler) if alone and compiler.is_pure() else None
        if written is not None:
            cache.keep(key, [written])

    def load_library(self, paths: list[str]) -> None:
        """Load the library, all of it or none from the cache."""
        stats = [(path, os.stat(path)) for path in paths]
        named = [f"{path} {stat.st_size} {stat.st_mtime_ns}" for path, stat in stats]
        key = self.circumstances = cache.digest(cache.fingerprint(), *named)
        if self._run_kept(key, run_apart):
            return
        entries = []
        for path in paths:
            source = decode(file_bytes(path), f"<stdlib>/{os.path.basename(path)}")
            compiler, _ = self._compile(source)
            entries.append(cache.write_down(compiler))
        if all(entry is not None for entry in entries):
            cache.keep(key, [entry for entry in entries if entry is not None])

    def _compile(self, source: Source, run: Run = run_apart) -> tuple[Any, Value]:
        """Compile and run a source form by form; its compiler, and the value of the last form."""
        compiler = self.session.compiler(source.name)
        result: Value = None
        run_code = self._runner(compiler.unit.load, run)
        for reading in self.session.readings(source):
            result = compiler.run(reading.form, reading.spans, reading.span, run=run_code)
        return compiler, result

    def _runner(self, load: Callable[[Any], FunctionType], run: Run) -> Callable[[Any], Value]:
        return lambda code: run(load(code))

    def _run_kept(self, key: str, run: Run) -> bool:
        """Run the top-level forms of the texts kept under KEY; false if there are none."""
        texts = cache.fetch(key)
        for kept in texts or ():
            code = cache.take_up(kept, self.session.image, self.session.support)
            for form in kept.codes:
                run(code.load(form))
        return texts is not None
