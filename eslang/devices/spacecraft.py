"""What plans say to the spacecraft (ARM §2, §5), as far as Python answers it.

Registered through the embedding interface alone. The commands, which wait,
are in stdlib/spacecraft.esl. The hardware is imported when a plan first speaks
of a device, since few plans do.
"""

from __future__ import annotations

from eslang.base.hints import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from eslang.devices.commands import Sent
    from eslang.devices.hardware import Hardware
    from eslang.interpreter import Interpreter


class Spacecraft:
    """The spacecraft of one interpreter."""

    def __init__(self, agent: Interpreter) -> None:
        self.agent = agent
        self._hardware: Hardware | None = None

    @property
    def hardware(self) -> Hardware:
        """Its hardware, as described when a plan first spoke of it."""
        if self._hardware is None:
            from eslang.devices.hardware import Hardware

            self._hardware = Hardware(self.agent)
        return self._hardware

    def send_command(self, device: Any, command: Any) -> Sent:
        """Send COMMAND to DEVICE, and do not wait."""
        return self.hardware.send(device, command)

    def is_device(self, name: Any) -> bool:
        """Tell whether NAME is that of a device."""
        return self.hardware.is_device(name)

    def device_power_state(self, device: Any) -> Any:
        """Tell whether DEVICE has power, as far as its sensor has told.

        It is what the fact (power-state DEVICE ?state) says.

        Returns: :on or :off; NIL for a switch, which has no such sensor.
        Fails:   :unknown-device, with DEVICE and the nearest name there is.

        Example:
            ? (progn (load-spacecraft) (device-power-state :ega_x))
            :OFF

        Source: ARM §2; what is seen, and when: decision 28.
        """
        from eslang.devices.description import POWER_STATE

        return self.hardware.state(device, POWER_STATE)

    def device_health_state(self, device: Any) -> Any:
        """Tell how DEVICE is, as far as its sensors have told.

        It is what the fact (health-state DEVICE ?state) says. Sensors of a
        device without power tell nothing, and none tell that a switch is
        stuck.

        Returns: :ok, :single-event-upset or :permanent-failure; :tripped for
                 a bus that has tripped.
        Fails:   :unknown-device, with DEVICE and the nearest name there is.

        Example:
            ? (progn (load-spacecraft) (device-health-state :ega_x))
            :OK

        Source: ARM §2; what is seen, and when: decision 28.
        """
        from eslang.devices.description import HEALTH_STATE

        return self.hardware.state(device, HEALTH_STATE)

    def break_device(self, device: Any, health: Any) -> Any:
        """Let DEVICE be in the state HEALTH from now on.

        HEALTH is :single-event-upset, which a reset mends; :permanent-failure;
        :stuck, of a switch, which then stays as it is; :tripped, of a bus; or
        :ok, which mends everything. Plans learn of it from the sensors.

        Returns: HEALTH.
        Fails:   :unknown-device, :unknown-health, with the nearest name.

        Example:
            ? (load-spacecraft)
            :SPACECRAFT
            ? (break-device :neb1 :single-event-upset)
            :SINGLE-EVENT-UPSET
            ? (progn (sleep 1) (device-health-state :neb1))
            :SINGLE-EVENT-UPSET

        Source: ARM §2, §5; language reference §8.
        """
        self.hardware.change_health(device, health)
        return health


def next_pause(sent: Sent) -> float | None:
    """Tell how long to wait for what was SENT, before this is asked again; NIL if the reply is there."""
    return sent.next_pause()


def reply(sent: Sent) -> Any:
    """Give what was SENT gives, or fail."""
    return sent.reply()


def install(agent: Interpreter) -> Spacecraft:
    """Give an interpreter its spacecraft, and return it."""
    craft = Spacecraft(agent)
    agent.primitive(signature="(esl::%send-command device command)")(craft.send_command)
    agent.primitive(signature="(esl::%next-pause sent)", outside=False)(next_pause)
    agent.primitive(signature="(esl::%reply sent)", outside=False)(reply)
    agent.primitive(signature="(esl::%device-p name)", outside=False)(craft.is_device)
    agent.primitive(signature="(esl::device-power-state device)", outside=False)(craft.device_power_state)
    agent.primitive(signature="(esl::device-health-state device)", outside=False)(craft.device_health_state)
    agent.primitive(signature="(esl::break-device device health)", outside=False)(craft.break_device)
    return craft
