"""FORMAT's directives that enclose others: ~( ~[ ~{ ~<, and ~? and ~^ (CLHS 22.3.5-7, 22.3.9)."""

from __future__ import annotations

from eslang.base.lists import items
from eslang.base.sameness import is_eql
from eslang.base.symbols import Value
from eslang.lisp.format_control import Directive, Items, directive, parse_control
from eslang.lisp.format_run import ANY, GO_ON, LEAVE, LEAVE_ALL, Run
from eslang.lisp.format_text import BLANK
from eslang.lisp.strings import capitalize, check_string

_LINE = 72  # how long a line is, where nobody says


@directive("(")
def convert_case(run: Run, directive: Directive) -> int:
    """~(text~): TEXT in lower case; `:` capitalizes words, `@` the first one, `:@` all letters."""
    text, way = run.captured(directive.clauses[0])
    if directive.colon and directive.at:
        text = text.upper()
    elif directive.colon:
        text = capitalize(text)
    else:
        text = text.lower()
        if directive.at:
            first = next((place for place, char in enumerate(text) if char.isalnum()), len(text))
            text = text[:first] + text[first : first + 1].upper() + text[first + 1 :]
    run.out.write(text)
    return way


@directive("[", parameters=1)
def choose(run: Run, directive: Directive) -> int:
    """~[a~;b~]: the clause that an integer chooses; `:` by NIL or not, `@` if not NIL."""
    clauses = directive.clauses
    if directive.colon:
        return run.perform(clauses[0 if run.next(directive) is None else 1])
    if directive.at:
        if run.next(directive) is None:
            return GO_ON
        run.place -= 1
        return run.perform(clauses[0])
    (number,) = run.parameters(directive, None)
    if number is None:
        number = run.next(directive)
    if number.__class__ is not int:
        raise directive.wrong("the argument is not an integer", number)
    if 0 <= number < len(clauses):
        return run.perform(clauses[number])
    if directive.separators and directive.separators[-1].colon:
        return run.perform(clauses[-1])
    return GO_ON


@directive("?")
def recur(run: Run, directive: Directive) -> int:
    """~?: an argument as control string, and its arguments in a list; with `@` the arguments to come."""
    control = parse_control(check_string(run.next(directive), "format").text)
    if directive.at:
        run.perform(control)
    else:
        Run(run.out, items(run.next(directive))).perform(control)
    return GO_ON


@directive("{", parameters=1)
def iterate(run: Run, directive: Directive) -> int:
    """~{text~}: TEXT for the elements of a list; `@` the arguments to come, `:` each a list."""
    (most,) = run.parameters(directive, None)
    body = directive.clauses[0] or parse_control(check_string(run.next(directive), "format").text)
    inner = run if directive.at else Run(run.out, items(run.next(directive)))
    at_least_once = directive.closing is not None and directive.closing.colon
    count = 0
    while (most is None or count < most) and (inner.left or (at_least_once and count == 0)):
        before = inner.place
        way = _step(inner, directive, body)
        count += 1
        if way == LEAVE_ALL or (way == LEAVE and not directive.colon):
            break
        if most is None and inner.place == before and inner.left:
            raise directive.wrong("each step leaves all arguments, so it would never end")
        if not inner.left:
            break
    return GO_ON


def _step(inner: Run, directive: Directive, body: Items) -> int:
    if not directive.colon:
        return inner.perform(body)
    arguments = items(inner.next(directive)) if inner.left else []
    return Run(inner.out, arguments, inner).perform(body)


@directive("^", parameters=3)
def escape(run: Run, directive: Directive) -> int:
    """~^: go no further if no arguments are left, or as the parameters say."""
    numbers = [number for number in run.parameters(directive, ANY, ANY, ANY) if number is not ANY]
    if not numbers:
        holder = run.outer if directive.colon and run.outer is not None else run
        leave = holder.left == 0
    elif len(numbers) == 1:
        leave = is_eql(numbers[0], 0)
    elif len(numbers) == 2:
        leave = is_eql(numbers[0], numbers[1])
    else:
        leave = _ascend(numbers, directive)
    return (LEAVE_ALL if directive.colon else LEAVE) if leave else GO_ON


def _ascend(numbers: list[Value], directive: Directive) -> bool:
    for number in numbers:
        if number.__class__ is not int:
            raise directive.wrong("a parameter is not an integer", number)
    return bool(numbers[0] <= numbers[1] <= numbers[2])


@directive("<", parameters=4)
def justify(run: Run, directive: Directive) -> int:
    """~mincol,colinc,minpad,padchar<a~;b~>: texts spread over a width; with ~:> just written."""
    if directive.closing is not None and directive.closing.colon:
        return _write_block(run, directive)
    width, step, least, pad = run.parameters(directive, 0, 1, 0, BLANK)
    clauses, separators = directive.clauses, directive.separators
    overflow, spare, line = "", 0, _LINE
    texts: list[str] = []
    if separators and separators[0].colon:
        overflow, way = run.captured(clauses[0])
        spare, line = run.parameters(separators[0], 0, _LINE)
        clauses = clauses[1:]
        if way:
            return GO_ON
    for clause in clauses:
        text, way = run.captured(clause)
        if way:
            break
        texts.append(text)
    spread = _spread(texts, [width, step, least, pad], directive.colon, directive.at)
    if overflow and run.out.column + len(spread) + spare > line:
        run.out.write(overflow)
    run.out.write(spread)
    return GO_ON


def _spread(texts: list[str], layout: list[Value], before: bool, after: bool) -> str:
    """TEXTS with padding between them, and BEFORE and AFTER them."""
    width, step, least, pad = layout
    before = before or (len(texts) <= 1 and not after)
    gaps = max(len(texts) - 1, 0) + before + after
    size = gaps * least + sum(map(len, texts))
    if size > width:
        step = max(step, 1)
        width += (size - width + step - 1) // step * step
    padding = width - size + gaps * least
    pieces: list[str] = []
    for place, text in enumerate(texts or [""]):
        if place or before:
            share = padding // gaps
            padding, gaps = padding - share, gaps - 1
            pieces.append(pad.char * share)
        pieces.append(text)
    return "".join(pieces) + (pad.char * padding if after else "")


def _write_block(run: Run, directive: Directive) -> int:
    """~<prefix~;body~;suffix~:>: a logical block, all in one line."""
    clauses = directive.clauses
    if len(clauses) > 3:
        raise directive.wrong("at most three clauses")
    prefix, suffix = ("(", ")") if directive.colon else ("", "")
    if len(clauses) > 1:
        prefix, _ = run.captured(clauses[0])
    if len(clauses) > 2:
        suffix, _ = run.captured(clauses[2])
    inner = run if directive.at else Run(run.out, items(run.next(directive)))
    run.out.write(prefix)
    inner.perform(clauses[1] if len(clauses) > 1 else clauses[0])
    if directive.at:
        run.place = len(run.arguments)
    run.out.write(suffix)
    return GO_ON
