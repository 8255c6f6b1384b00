"""The body of the robot: its wheels, its battery, its gripper, and what it senses.

Time goes in ticks as long as anything moves. In each, all go on a little, with
noise from the interpreter's chance, and what the sensors tell becomes facts,
(robot-senses SENSOR VALUE), as one change. Nothing that stands still costs time.
"""

from __future__ import annotations

from math import hypot

from eslang.base.failure import Failure
from eslang.base.hints import TYPE_CHECKING, Any, Callable
from eslang.base.suggest import nearest
from eslang.base.symbols import Keyword, Symbol
from eslang.devices.plane import ROBOT_RADIUS, Disc, Edge, Plane, direction, sight, turned, unit

if TYPE_CHECKING:
    from eslang.interpreter import Interpreter

TICK = 0.1  # seconds
FARTHEST = 4.0  # metres that the range sensors see
CONE = (-15.0, 0.0, 15.0)  # in which they do: the nearest thing counts
FAR_ENOUGH, STRAIGHT, CENTRED = 0.5, 15.0, 0.15  # how near, straight and central a grab must be
STUCK_AFTER = 1.0  # seconds in which the wheels turn in vain
DRAIN = 0.25  # percent of the battery that a metre takes
CHARGE = 5.0  # percent a second that it takes up
DRIVING, SPINNING, STILL = Keyword("DRIVING"), Keyword("SPINNING"), Keyword("STILL")
OK, STUCK, BLIND = Keyword("OK"), Keyword("STUCK"), Keyword("BLIND")
STATES = (OK, STUCK, BLIND)
SENSES = Symbol.intern("ROBOT-SENSES", "ESL")
RANGES = {"AHEAD": 0.0, "LEFT": 90.0, "BEHIND": 180.0, "RIGHT": -90.0}
PLACES = ("DISTANCE", "BEARING")  # of a place that is told
BAR = ("BAR-DISTANCE", "BAR-BEARING", "BAR-OFFSET", "MIDLINE-BEARING")
OWN = ("BATTERY", "MOTION", "BUMPED", "HOLDS")  # what the robot feels of itself
TOLD = (*RANGES, *BAR, "X", "Y", "HEADING", *OWN)
UNSEEN = (*RANGES, *BAR)  # when it is blind


class Motion:
    """Something that the wheels do, until it is over."""

    __slots__ = ("idle", "is_over", "kind", "left", "rate", "trouble")

    def __init__(self, kind: Keyword, rate: float, left: float | None) -> None:
        self.kind = kind
        self.rate = rate  # metres or degrees a second
        self.left = left  # how far it is to go; None if it goes on for ever
        self.idle = 0.0
        self.is_over = False
        self.trouble: tuple[Any, ...] | None = None

    def end(self, *trouble: Any) -> None:
        """It is over, with TROUBLE if it did not do what it is for."""
        self.is_over = True
        self.trouble = trouble or None


class Body:
    """The robot, in its plane."""

    def __init__(self, agent: Interpreter) -> None:
        self.facts = agent.facts
        self.after: Callable[[float, Callable[[], None]], None] = agent.after
        self.chance = agent.chance
        self.plane = Plane()
        self.x = self.y = self.heading = self.noise = 0.0
        self.battery = 100.0
        self.is_placed = self.is_ticking = False
        self.motion: Motion | None = None
        self.bumped: Any = None
        self.holds: Any = None
        self.state = OK
        self.told: dict[str, Any] = {}
        self.around: list[Edge | Disc] = []  # what the range sensors can see
        agent.call("esl::%declare-senses")

    def place(self, x: float, y: float, heading: float, noise: float) -> None:
        """Put it at (X, Y), looking to HEADING; NOISE is the share by which it errs."""
        self.x, self.y, self.heading, self.noise = x, y, heading, noise
        self.is_placed = True
        self.tell()

    # --- the wheels --------------------------------------------------------------

    def begin(self, kind: Keyword, rate: float, amount: float | None) -> Motion:
        """Let the wheels turn. Raises Failure if they do something else, or cannot."""
        if not self.is_placed:
            raise Failure("no-robot")
        if self.motion is not None:
            raise Failure("robot-busy", self.motion.kind)
        if self.battery <= 0:
            raise Failure("battery-flat")
        left = None if amount is None else abs(amount)
        motion = self.motion = Motion(kind, rate if amount is None or amount > 0 else -rate, left)
        self.bumped = None
        if left == 0:
            motion.end()
        self.tell(OWN)
        self.go_on()
        return motion

    def stop(self, motion: Motion) -> None:
        """MOTION is over, for whoever began it."""
        if self.motion is motion:
            self.motion = None
            self.tell(OWN)

    def roll(self, motion: Motion) -> None:
        """Let the wheels turn for one tick."""
        far = abs(motion.rate) * TICK
        if motion.left is not None:
            far = min(far, motion.left)
            motion.left -= far
        if self.state is STUCK:
            motion.left = None if motion.left is None else motion.left + far
            motion.idle += TICK
            if motion.idle > STUCK_AFTER:
                motion.end("wheels-stuck")
            return
        far *= self.chance.gauss(1.0, self.noise) if motion.rate >= 0 else -self.chance.gauss(1.0, self.noise)
        if motion.kind is SPINNING:
            self.heading = turned(self.heading + far)
        else:
            self.advance(motion, far)
        if motion.left is not None and motion.left < 1e-9 and not motion.is_over:
            motion.end()
        if self.battery <= 0 and not motion.is_over:
            motion.end("battery-flat")

    def advance(self, motion: Motion, far: float) -> None:
        """Go FAR in the direction of the robot, unless something is there."""
        ux, uy = unit(self.heading)
        x, y = self.x + far * ux, self.y + far * uy
        clear, name = self.plane.nearest(x, y)
        if clear < ROBOT_RADIUS and clear < self.plane.nearest(self.x, self.y)[0]:
            self.bumped = name_of(name)
            motion.end("bumped", self.bumped)
            return
        self.x, self.y = x, y
        self.battery = max(0.0, self.battery - DRAIN * abs(far))
        self.heading = turned(self.heading + self.chance.gauss(0.0, 10 * self.noise))

    # --- time --------------------------------------------------------------------

    def go_on(self) -> None:
        """Let time go in ticks, if it does not."""
        if not self.is_ticking:
            self.is_ticking = True
            self.after(TICK, self.tick)

    def tick(self) -> None:
        """All that moves goes on a little; the sensors tell."""
        self.is_ticking = False
        moves = self.plane.walk(TICK, self.x, self.y)
        if self.motion is not None and not self.motion.is_over:
            self.roll(self.motion)
            moves = True
        self.tell()
        if moves:
            self.go_on()

    # --- sensors -----------------------------------------------------------------

    def tell(self, sensors: tuple[str, ...] = TOLD) -> None:
        """Let the facts say what SENSORS tell now."""
        if not self.is_placed:
            return
        if sensors is TOLD:
            self.look_around()
        now = {name: self.read(name) for name in sensors}
        gone = [name for name, value in now.items() if value is None and self.told.get(name) is not None]
        news = [
            [Keyword(name), value] for name, value in now.items() if value not in (None, self.told.get(name))
        ]
        self.told.update(now)
        for name in gone:
            self.facts.remove([SENSES, Keyword(name), "?_"])
        if news:
            self.facts.add_all(news, SENSES)

    def look_around(self) -> None:
        """Find out what the range sensors can see from here."""
        self.around = self.plane.near(self.x, self.y, FARTHEST + ROBOT_RADIUS)

    def sense(self, sensor: Any, *place: Any) -> Any:
        """What SENSOR tells now, of a PLACE if it is one that takes one."""
        known = (*TOLD, *PLACES)
        name = sensor.name if isinstance(sensor, Symbol) else None
        if name not in known:
            near = nearest(name, known) if name else None
            raise Failure("unknown-sensor", sensor, *([Keyword(near)] if near else []))
        if not self.is_placed:
            raise Failure("no-robot")
        if name not in PLACES:
            self.look_around()
            return self.read(name)
        if len(place) != 2:
            raise Failure("no-place", sensor, list(place))
        return self.far(*place) if name == "DISTANCE" else self.bearing(*place)

    def read(self, name: str) -> Any:
        """What the sensor NAME tells, with its noise; None if that is nothing."""
        if self.state is BLIND and name in UNSEEN:
            return None
        if name in RANGES:
            way = self.heading + RANGES[name]
            far = min([sight(self.around, self.x, self.y, way + each) for each in CONE]) - ROBOT_RADIUS
            return self.metres(min(FARTHEST, max(0.0, far)))
        if name in BAR:
            return self.read_bar(name)
        if name in ("X", "Y"):
            return self.metres(self.x if name == "X" else self.y)
        if name == "HEADING":
            return self.angle(self.heading)
        if name == "MOTION":
            return STILL if self.motion is None or self.motion.is_over else self.motion.kind
        return {"BATTERY": round(self.battery), "BUMPED": self.bumped, "HOLDS": self.holds}[name]

    def read_bar(self, name: str) -> float | None:
        """What the sensor NAME tells of the bar."""
        bar = self.plane.bar
        if bar is None:
            return None
        if name == "BAR-DISTANCE":
            return self.far(bar.x, bar.y)
        if name == "BAR-OFFSET":
            return self.metres(bar.offset(self.x, self.y))
        return self.bearing(*(bar[:2] if name == "BAR-BEARING" else bar.zone(self.x, self.y)))

    def far(self, x: float, y: float) -> float:
        """How far (X, Y) seems to be."""
        return max(0.0, self.metres(hypot(x - self.x, y - self.y)))

    def bearing(self, x: float, y: float) -> float:
        """In which direction (X, Y) seems to be, seen from the robot."""
        return self.angle(direction(self.x, self.y, x, y) - self.heading)

    def metres(self, true: float) -> float:
        """A length as it is sensed."""
        return round(true + self.chance.gauss(0.0, self.noise), 2)

    def angle(self, true: float) -> float:
        """An angle as it is sensed."""
        return round(turned(true + self.chance.gauss(0.0, 50 * self.noise)), 1)

    # --- the gripper, and the battery ---------------------------------------------

    def grab(self) -> Any:
        """Close the gripper around the bar. Raises Failure if that is not there."""
        bar = self.plane.bar
        if self.holds is not None:
            raise Failure("gripper-full", self.holds)
        if bar is None or not self.is_at(bar):
            raise Failure(
                "nothing-to-grab", *([] if bar is None else [self.read_bar(BAR[0]), self.read_bar(BAR[1])])
            )
        self.holds = Keyword("BAR")
        self.plane.bar = None
        self.tell()
        return self.holds

    def is_at(self, bar: Any) -> bool:
        """Whether the gripper is around BAR."""
        away = turned(direction(self.x, self.y, bar.x, bar.y) - self.heading)
        near = hypot(bar.x - self.x, bar.y - self.y) <= FAR_ENOUGH
        return near and abs(away) <= STRAIGHT and abs(bar.offset(self.x, self.y)) <= CENTRED

    def charging_time(self) -> float:
        """How long it takes to charge the battery. Raises Failure if there is no charger within reach."""
        charger = self.plane.charger
        if charger is None or hypot(charger[0] - self.x, charger[1] - self.y) > FAR_ENOUGH:
            raise Failure("no-charger")
        return (100.0 - self.battery) / CHARGE

    def charge(self) -> None:
        """The battery is full, if the robot is still at the charger."""
        self.charging_time()
        self.battery = 100.0
        self.tell(OWN)


def name_of(key: Any) -> Any:
    """The name of the thing that is known in the plane by KEY."""
    return list(map(name_of, key)) if isinstance(key, tuple) else key
