"""The simulated world that plans act on.

In reading order: the widget of ESL §2.3; the spacecraft of ARM §5 (a device,
the description, power, commands, the hardware, what plans say to it); the
actions of a scenario, and the scenario; the environments of Gymnasium; the
robot (its plane, its body, what plans say to it). Every device registers itself
through the public embedding interface and uses nothing else, as a user's own would.

This room must not know how a plan is compiled or run.
"""
