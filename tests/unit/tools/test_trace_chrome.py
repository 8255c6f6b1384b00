"""The trace event format: what the viewers of Chrome and Perfetto expect holds of what is written."""

from __future__ import annotations

import json
from collections import defaultdict
from pathlib import Path
from typing import Any

import pytest
from unit.tools.command import call
from unit.tools.traced import EVERY_KIND, RESCUE, traced, written

from eslang.tools.trace_chrome import chrome_text

PHASES = {"M", "X", "i", "s", "f"}


def events_of(text: str) -> list[dict[str, Any]]:
    """The events of the run of TEXT, in the format."""
    whole = json.loads(chrome_text(traced(text)))
    assert set(whole) == {"traceEvents", "displayTimeUnit", "otherData"}
    assert whole["displayTimeUnit"] in ("ms", "ns")
    found: list[dict[str, Any]] = whole["traceEvents"]
    return found


@pytest.mark.parametrize("text", [RESCUE, EVERY_KIND, "1"])
class TestFormat:
    """Rules that hold of every trace."""

    def test_every_event_has_its_fields(self, text: str) -> None:
        for event in events_of(text):
            assert event["ph"] in PHASES
            assert isinstance(event["name"], str)
            assert isinstance(event["pid"], int)
            assert isinstance(event["tid"], int)
            assert isinstance(event["ts"], (int, float))
            assert event["ts"] >= 0
            if event["ph"] == "X":
                assert event["dur"] >= 0
            if event["ph"] == "i":
                assert event["s"] in ("t", "p", "g")

    def test_times_do_not_go_back(self, text: str) -> None:
        times = [event["ts"] for event in events_of(text) if event["ph"] != "M"]
        assert times == sorted(times)

    def test_every_track_has_a_name(self, text: str) -> None:
        events = events_of(text)
        named = [event["tid"] for event in events if event["name"] == "thread_name"]
        assert len(named) == len(set(named))
        assert {event["tid"] for event in events if event["ph"] != "M"} <= {*named, 0}

    def test_the_slices_of_a_track_lie_in_one_another_or_apart(self, text: str) -> None:
        tracks: dict[int, list[tuple[float, float]]] = defaultdict(list)
        for event in events_of(text):
            if event["ph"] == "X":
                tracks[event["tid"]].append((event["ts"], event["ts"] + event["dur"]))
        for slices in tracks.values():
            for first, last in slices:
                for begin, end in slices:
                    apart, within = last <= begin or end <= first, (begin <= first and last <= end)
                    around = first <= begin and end <= last
                    assert apart or within or around

    def test_every_flow_has_two_ends_each_in_a_slice(self, text: str) -> None:
        events = events_of(text)
        ends: dict[int, list[dict[str, Any]]] = defaultdict(list)
        for event in events:
            if event["ph"] in "sf":
                ends[event["id"]].append(event)
                slices = [each for each in events if each["ph"] == "X" and each["tid"] == event["tid"]]
                assert any(each["ts"] <= event["ts"] <= each["ts"] + each["dur"] for each in slices)
        for first, last in ends.values():
            assert (first["ph"], last["ph"], last["bp"]) == ("s", "f", "e")
            assert (first["name"], first["cat"]) == (last["name"], last["cat"])
            assert first["ts"] <= last["ts"]


def test_what_the_tracks_tell() -> None:
    events = events_of(RESCUE)
    tracks = {event["tid"]: event["args"]["name"] for event in events if event["name"] == "thread_name"}
    slices = {(tracks[event["tid"]], event["name"]) for event in events if event["ph"] == "X"}
    assert slices >= {
        ("watcher", "watcher"),
        ("watcher", "waiting"),
        ("watcher", "cleanup"),
        ("arm", "recovery"),
        ("arm", "sleeping"),
        ("guarded", "interrupt"),
    }
    failed = [event for event in events if event["ph"] == "i" and event["name"] == "failure"]
    assert [tracks[event["tid"]] for event in failed] == ["camera"]
    assert failed[0]["args"]["what"].startswith("fails: :DEADLINE-EXPIRED 5")
    assert failed[0]["ts"] == pytest.approx(6e6, abs=100)


def test_the_command_writes_it_beside_the_trace(tmp_path: Path) -> None:
    path = tmp_path / "run.jsonl"
    path.write_text(written(RESCUE))
    assert call(["trace", "--perfetto", str(path)]) == (0, f"{tmp_path / 'run.perfetto.json'}\n", "")
    assert json.loads((tmp_path / "run.perfetto.json").read_text())["traceEvents"]
