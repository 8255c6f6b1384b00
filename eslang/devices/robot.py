"""What plans say to the robot, as far as Python answers it.

Registered through the embedding interface alone, under one name; the rest is
in stdlib/robot.esl. The robot's body is imported when a plan first speaks of
it, since few plans do.
"""

from __future__ import annotations

from eslang.base.failure import Failure, type_error
from eslang.base.hints import TYPE_CHECKING, Any, Callable
from eslang.base.symbols import Keyword

if TYPE_CHECKING:
    from eslang.devices.robot_body import Body, Motion
    from eslang.interpreter import Interpreter


class Robot:
    """The robot of one interpreter."""

    def __init__(self, agent: Interpreter) -> None:
        self.agent = agent
        self._body: Body | None = None

    @property
    def body(self) -> Body:
        """Its body, made when a plan first speaks of it."""
        if self._body is None:
            from eslang.devices.robot_body import Body

            self._body = Body(self.agent)
        return self._body

    def answer(self, word: Keyword, *arguments: Any) -> Any:
        """Do, or tell, what WORD says."""
        return WORDS[word.name](self.body, *arguments)


# --- what is in the plane ---------------------------------------------------------------


def numbers(*values: Any) -> list[float]:
    """VALUES, which are to be real numbers."""
    for value in values:
        if value.__class__ not in (int, float) and value.__class__.__name__ != "Fraction":
            raise type_error(value, "REAL")
    return [float(value) for value in values]


def key_of(name: Any) -> Any:
    """What a thing is known by in the plane: its name, which may be a list."""
    return tuple(map(key_of, name)) if isinstance(name, list) else name


def place_robot(body: Body, x: Any, y: Any, heading: Any, noise: Any) -> None:
    """Put the robot somewhere."""
    body.place(*numbers(x, y, heading, noise))


def place_wall(body: Body, name: Any, *corners: Any) -> Any:
    """Build a wall from corner to corner."""
    from eslang.devices.plane import Edge

    places = numbers(*corners)
    if len(places) < 4 or len(places) % 2:
        raise Failure("no-wall", list(corners))
    body.plane.walls[key_of(name)] = [Edge(*places[at : at + 4]) for at in range(0, len(places) - 2, 2)]
    body.tell()
    return name


def place_obstacle(body: Body, name: Any, x: Any, y: Any, radius: Any) -> Any:
    """Put something round somewhere."""
    from eslang.devices.plane import Disc

    body.plane.discs[key_of(name)] = Disc(*numbers(x, y, radius))
    body.tell()
    return name


def move_obstacle(body: Body, name: Any, x: Any, y: Any, speed: Any) -> Any:
    """Let something round go somewhere."""
    disc = body.plane.discs.get(key_of(name))
    if disc is None:
        raise Failure("unknown-thing", name)
    gx, gy, disc.speed = numbers(x, y, speed)
    disc.goal = gx, gy
    body.go_on()
    return name


def place_bar(body: Body, x: Any, y: Any, angle: Any) -> Any:
    """Put the bar somewhere."""
    from eslang.devices.plane import Bar

    body.plane.bar = Bar(*numbers(x, y, angle))
    body.holds = None
    body.tell()
    return Keyword("BAR")


def place_charger(body: Body, x: Any, y: Any) -> Any:
    """Put the charger somewhere."""
    gx, gy = numbers(x, y)
    body.plane.charger = gx, gy
    return Keyword("CHARGER")


def remove_thing(body: Body, name: Any) -> Any:
    """Take away a wall, or something round."""
    key = key_of(name)
    found = body.plane.walls.pop(key, None), body.plane.discs.pop(key, None)
    body.tell()
    return None if found == (None, None) else name


def break_robot(body: Body, state: Any) -> Any:
    """Let the robot be broken as STATE says, or well."""
    from eslang.devices.robot_body import STATES

    if not any(state is each for each in STATES):
        raise Failure("unknown-state", state, list(STATES))
    body.state = state
    body.tell()
    return state


# --- what the robot does ----------------------------------------------------------------


def begin_motion(body: Body, word: Any, rate: Any, amount: Any) -> Motion:
    """Let the wheels turn, for an AMOUNT unless that is None."""
    [speed, *far] = numbers(rate, *([] if amount is None else [amount]))
    return body.begin(word, speed, far[0] if far else None)


def outcome(body: Body, motion: Motion) -> None:
    """Nothing, if MOTION did what it was for. Raises Failure otherwise."""
    if motion.trouble is not None:
        raise Failure(*motion.trouble)


def release(body: Body) -> Any:
    """Open the gripper; what it held lies where the robot is."""
    held = body.holds
    if held is not None:
        place_bar(body, body.x, body.y, body.heading + 90.0)
    return held


WORDS: dict[str, Callable[..., Any]] = {
    "PLACE-ROBOT": place_robot,
    "PLACE-WALL": place_wall,
    "PLACE-OBSTACLE": place_obstacle,
    "MOVE-OBSTACLE": move_obstacle,
    "PLACE-BAR": place_bar,
    "PLACE-CHARGER": place_charger,
    "REMOVE": remove_thing,
    "BREAK": break_robot,
    "BEGIN": begin_motion,
    "OUTCOME": outcome,
    "STOP": lambda body, motion: body.stop(motion),
    "SENSE": lambda body, sensor, *place: body.sense(sensor, *numbers(*place)),
    "GRAB": lambda body: body.grab(),
    "RELEASE": release,
    "CHARGING-TIME": lambda body: body.charging_time(),
    "CHARGE": lambda body: body.charge(),
    "POSE": lambda body: [body.x, body.y, body.heading],
}


def install(agent: Interpreter) -> None:
    """Give an interpreter its robot."""
    agent.primitive(signature="(esl::%robot word &rest arguments)")(Robot(agent).answer)
