"""The emitter: functions and their parameters.

A closure made inside a loop must keep the variables of its own round. Those
are handed, by value, to a small factory that defines the function; variables
that also change live in a Box, which is handed over instead.
"""

from __future__ import annotations

import ast
import sys

from eslang.compile import core
from eslang.compile.core import Const, KeyParameter, Lambda, Optional, Variable
from eslang.compile.emit import PLAIN, Destination
from eslang.compile.emit_statements import StatementEmitter

# Python 3.13 up to 3.13.7 looks for the end of the stack only where a function gets just the arguments
# that it has parameters for (CPython issue 132744); so one with other parameters must look for itself.
UNCHECKED = (3, 13) <= sys.version_info < (3, 13, 8)


class Emitter(StatementEmitter):
    """Emits one procedure, and the procedures inside it."""

    def closure(self, node: Lambda) -> ast.expr:
        name = self.unit.function_name(node)
        self.define_functions([(name, node)])
        return self.name(name)

    def define_functions(self, functions: list[tuple[str, Lambda]]) -> None:
        """Put the definitions of functions, in a factory if they need variables of their own."""
        names = [name for name, _ in functions]
        fresh: dict[str, None] = {}
        for _, node in functions:
            for variable in node.procedure.free:
                if variable.fresh and variable.owner is self.procedure and variable.name not in names:
                    fresh[variable.name] = None
        definitions = [self.definition(name, node) for name, node in functions]
        if not fresh:
            self.block.extend(definitions)
            return
        factory = self.temporary()
        result = self.name(names[0]) if len(names) == 1 else self.tuple([self.name(name) for name in names])
        self.put(self.define(factory, list(fresh), [], None, [*definitions, self.give(result)]))
        made = self.call(self.name(factory), [self.name(name) for name in fresh])
        self.put(self.assign(names[0], made) if len(names) == 1 else self.assign_all(names, made))

    def definition(self, name: str, node: Lambda, *, many: bool = False) -> ast.stmt:
        """The Python definition of a function."""
        inner = Emitter(self.unit, node.procedure, many=many)
        inner.nesting = self.nesting
        inner.at = self.at
        inner.move(node.span)
        return inner.function(name, node)

    def run_localfunctions(self, node: core.LocalFunctions, destination: Destination) -> None:
        self.define_local(node)
        self.run(node.body, destination)

    def value_localfunctions(self, node: core.LocalFunctions, many: bool) -> ast.expr:
        self.define_local(node)
        return self.value(node.body, many)

    def define_local(self, node: core.LocalFunctions) -> None:
        """Define the functions of FLET or LABELS under the names of their variables."""
        for variable, function in node.functions:
            self.unit.number(function)
            self.unit.stable.add(variable.name)
        self.define_functions([(variable.name, function) for variable, function in node.functions])

    # --- one function ----------------------------------------------------------

    def function(self, name: str, node: Lambda) -> ast.stmt:
        """The definition of this procedure as the function NODE."""
        parameters = [variable.name for variable in node.required]
        defaults: list[ast.expr] = []
        for optional in node.optional:
            parameters.append(optional.variable.name)
            defaults.append(self.plain_default(optional) or self.name("%Unsupplied"))
        rest = self.rest_name(node)
        body = self.body_of(lambda: self.function_body(node, rest))
        if self.nonlocals:
            body.insert(0, self.nonlocal_(list(self.nonlocals)))
        self.unit.number(node)
        self.unit.title(name, node)
        return self.define(name, parameters, defaults, rest, body)

    def function_body(self, node: Lambda, rest: str | None) -> None:
        if UNCHECKED and (node.optional or rest is not None):
            self.put(self.effect(self.call_support("%here")))
        self.box_parameters(node.required)
        for optional in node.optional:
            self.optional_parameter(optional)
        if node.rest is not None and rest is not None and node.rest.mentioned:
            self.bind(node.rest, self.call_support("%list-of", self.name(rest)))
        if node.keys is not None and rest is not None:
            self.key_parameters(node, node.keys, rest)
        self.run(node.body, Destination("return", self.many))

    def box_parameters(self, variables: list[Variable]) -> None:
        for variable in variables:
            if variable.boxed:
                self.bind(variable, self.name(variable.name))

    def rest_name(self, node: Lambda) -> str | None:
        """The Python name of the rest parameter, if the function needs one."""
        if node.rest is None and node.keys is None:
            return None
        return self.temporary()

    def plain_default(self, optional: Optional) -> ast.expr | None:
        """A default that can stand in the Python parameter list."""
        if optional.supplied is None and isinstance(optional.default, Const):
            value = optional.default.value
            if value is None or value.__class__ in PLAIN:
                return self.constant(value)
        return None

    def optional_parameter(self, optional: Optional) -> None:
        """Give an optional parameter its default, and say whether it was supplied."""
        if self.plain_default(optional) is not None:
            self.box_parameters([optional.variable])
            return
        self.default(optional, self.name(optional.variable.name))

    def default(self, parameter: Optional | KeyParameter, given: ast.expr) -> None:
        """Bind a parameter to GIVEN, or to its default where GIVEN is %Unsupplied."""
        unsupplied = self.is_(given, self.name("%Unsupplied"))
        if parameter.supplied is not None and parameter.supplied.mentioned:
            truth = self.choose(unsupplied, self.constant(None), self.name("%T"))
            self.bind(parameter.supplied, truth)
        name = parameter.variable.name

        def compute() -> None:
            self.put(self.assign(name, self.value(parameter.default)))

        self.put(self.if_(unsupplied, self.body_of(compute), []))
        self.box_parameters([parameter.variable])

    def key_parameters(self, node: Lambda, keys: list[KeyParameter], rest: str) -> None:
        """Take the keyword arguments apart."""
        known = self.name(self.unit.constant_name(tuple(key.keyword for key in keys)))
        allow = self.constant(node.allow_other_keys)
        taken = self.call_support("%take-keys", self.name(rest), known, allow)
        if not keys:
            self.put(self.effect(taken))
            return
        self.put(self.assign_all([key.variable.name for key in keys], taken))
        for key in keys:
            self.default(key, self.name(key.variable.name))
