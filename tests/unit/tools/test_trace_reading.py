"""Reading a trace: what is cut is still told, what is wrong is refused with its line."""

from __future__ import annotations

from pathlib import Path

import pytest
from unit.tools.command import call
from unit.tools.traced import EVERY_KIND, RESCUE, written

from eslang.tools.trace_reading import CUT, ENDLESS, BadTrace, read_lines

WHOLE = written(RESCUE)
HEAD = '{"kind": "trace-begun", "format": 1}\n'


def refused(text: str | bytes) -> str:
    """Why TEXT is no trace."""
    with pytest.raises(BadTrace) as found:
        read_lines("run.jsonl", text if isinstance(text, bytes) else text.encode())
    return str(found.value)


def test_every_kind_of_event_can_be_read_back() -> None:
    trace = read_lines("run.jsonl", written(EVERY_KIND).encode())
    assert trace.remarks == []
    assert len(trace.records) == len(written(EVERY_KIND).splitlines()) - 2
    assert (trace.end, trace.last) == (trace.records[-1].time, trace.records[-1].time)


def test_a_last_line_that_is_cut_is_left_out_and_remarked() -> None:
    whole = read_lines("run.jsonl", WHOLE.encode())
    for cut in range(30, 300, 7):
        trace = read_lines("run.jsonl", WHOLE.encode()[:-cut])
        assert trace.remarks in ([CUT], [ENDLESS])
        assert whole.records[: len(trace.records)] == trace.records


def test_a_run_without_its_end_is_remarked() -> None:
    assert read_lines("run.jsonl", WHOLE[: WHOLE.rindex('{"kind"')].encode()).remarks == [ENDLESS]


@pytest.mark.parametrize(
    "text", ["", "\n", "hello\n", "(print 1)\n", "[]\n", "3\n", b"\xff\xfe\x00\x01", b"\x7fELF\n"]
)
def test_a_file_that_is_no_trace(text: str | bytes) -> None:
    assert refused(text) == "run.jsonl is no trace: `esl run --trace FILE` writes one"


def test_a_trace_without_its_beginning() -> None:
    assert refused(WHOLE.partition("\n")[2]) == "run.jsonl:1: the beginning of this trace is missing"


def test_a_trace_of_another_version() -> None:
    assert "another version" in refused('{"kind": "trace-begun", "format": 2}\n')


@pytest.mark.parametrize(
    ("line", "wrong"),
    [
        ("x", "this line is no event: 'x'"),
        ("{}", "this line is no event: '{}'"),
        ("[" * 50_000, f"this line is no event: '{'[' * 40}'"),
        ('{"kind": "wait"}', "this event has no time"),
        ('{"kind": "wait", "time": "1"}', "this event has no time"),
        ('{"kind": "wait", "time": NaN}', "this event has no time"),
        ('{"kind": "wait", "time": -1}', "this event has no time"),
        ('{"kind": "wait", "time": 1}', "this `wait` is wrong: on"),
        ('{"kind": "wait", "time": 1, "task": 3, "on": "x", "of": 1}', "this `wait` is wrong: task or form"),
        ('{"kind": "abort", "time": 1, "of": 3, "why": "net", "by": null}', "this `abort` is wrong: of"),
        ('{"kind": "failure", "time": 1, "failure": {"cause": 3}}', "this `failure` is wrong: failure"),
        ('{"kind": "checkpoint", "time": 1, "id": 1, "wakes": [3]}', "this `checkpoint` is wrong: wakes"),
    ],
)
def test_a_wrong_line_is_named(line: str, wrong: str) -> None:
    assert refused(f"{HEAD}{line}\n") == f"run.jsonl:2: {wrong}"


def test_a_kind_of_a_later_version_is_kept() -> None:
    trace = read_lines("run.jsonl", (HEAD + '{"kind": "dreamt", "time": 1, "of": "sheep"}\n').encode())
    assert trace.records[0].told == {"of": "sheep"}


def test_the_command_refuses_what_is_no_trace(tmp_path: Path) -> None:
    bad = tmp_path / "bad.jsonl"
    bad.write_text(HEAD + "oops\n")
    assert call(["trace", str(bad)]) == (65, "", f"esl: {bad}:2: this line is no event: 'oops'\n")
    code, _, err = call(["trace", str(tmp_path / "none")])
    assert (code, "no such file" in err) == (2, True)
    assert call(["trace", str(tmp_path)]).code == 2


@pytest.mark.parametrize("option", [[], ["--html", "-o", "-"], ["--perfetto", "-o", "-"]])
def test_any_beginning_of_a_trace_can_be_told(option: list[str], tmp_path: Path) -> None:
    path, lines = tmp_path / "run.jsonl", WHOLE.splitlines(keepends=True)
    for count in range(1, len(lines), 5):
        path.write_text("".join(lines[:count]))
        code, out, err = call(["trace", *option, str(path)])
        assert (code, err) == (0, "")
        assert out
