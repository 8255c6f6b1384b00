"""The floors of the house: a file imports only downward, and no room goes in circles."""

from __future__ import annotations

from architecture.sources import MODULES, Module, imports_of

FLOORS = {
    "base": 0,
    "reader": 1,
    "compile": 1,
    "runtime": 1,
    "facts": 1,
    "lisp": 2,
    "constructs": 2,
    "devices": 2,
    "constructs.esl": 3,
    "constructs.scs": 3,
    "interpreter": 4,  # and whatever else stands directly in eslang/
    "eslang": 5,  # the front door, for those who embed us and for the tools
    "tools": 6,
    "__main__": 7,
}

# A deferred import that closes a circle, and why it may.
CIRCLES = {
    ("eslang.base.symbols", "eslang.base.failure"): "a datum that refuses arithmetic says so as a failure",
    ("eslang.base.symbols", "eslang.base.printer"): "a datum shows itself to Python as it prints",
    ("eslang.base.lists", "eslang.base.printer"): "a list's text is how it prints",
    ("eslang.base.failure", "eslang.base.failure_text"): "a failure's text is how it prints",
    ("eslang.base.diagnostics", "eslang.base.render"): "an error's text is its layout",
}
NAMES = {module.name for module in MODULES}


def room_of(name: str) -> str:
    """The room in which the module NAME stands."""
    parts = name.split(".")[1:] or ["eslang"]
    if parts[0] == "constructs":
        return ".".join(parts[:2]) if parts[1:] and parts[1] in ("esl", "scs") else "constructs"
    return parts[0] if parts[0] in FLOORS else "interpreter"


def own_imports(module: Module) -> set[tuple[str, int]]:
    """The modules of ours that MODULE imports, with the line."""
    found = set()
    for name, taken, line in imports_of(module):
        deeper = f"{name}.{taken}"
        target = deeper if deeper in NAMES else name
        if target in NAMES and target != module.name:
            found.add((target, line))
    return found


def test_a_file_imports_only_from_a_lower_floor_or_its_own_room() -> None:
    wrong = []
    for module in MODULES:
        room = room_of(module.name)
        for target, line in own_imports(module):
            other = room_of(target)
            if other != room and FLOORS[other] >= FLOORS[room]:
                wrong.append(f"{module.place}:{line} ({room}) imports {target} ({other})")
    assert not wrong, "\n".join(wrong)


def test_no_room_goes_in_circles() -> None:
    graph = {module.name: {target for target, _ in own_imports(module)} for module in MODULES}
    for source, target in CIRCLES:
        graph[source].discard(target)
    done: set[str] = set()

    def follow(name: str, path: tuple[str, ...]) -> None:
        assert name not in path, " → ".join((*path[path.index(name) :], name))
        if name not in done:
            for target in sorted(graph[name]):
                follow(target, (*path, name))
            done.add(name)

    for name in sorted(graph):
        follow(name, ())


def test_every_circle_that_is_allowed_is_still_there() -> None:
    graph = {module.name: {target for target, _ in own_imports(module)} for module in MODULES}
    assert [pair for pair in CIRCLES if pair[1] not in graph[pair[0]]] == []


def test_a_rooms_sign_is_only_a_docstring() -> None:
    for module in MODULES:
        if module.path.name == "__init__.py" and module.name != "eslang":
            assert len(module.tree.body) == 1, f"{module.place} holds more than its docstring"
