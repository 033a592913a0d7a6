"""Which channel of a motor driver serves a port of a servo, and on which pins: those of the plan's channels."""

from __future__ import annotations

from collections.abc import Iterable

from robosmi.metamodels import migration, platform
from robosmi.transformations.queries.plans.plan_adapters import closure, port_calls
from robosmi.transformations.queries.plans.port_pins import bound_pin

SERVO = "servo"
"""The kind of component that a port of a servo expects, as the repository's data call it."""
ENCODER, FEEDBACK = "encoder", "feedback"
MOTORS = "motors"
"""The piece of the adapters that drives motors through the channels of motor drivers."""


def inputs_of(channel: migration.MotorChannel) -> list[platform.Pin]:
    """The pins at the inputs of a channel, without the one for standby."""
    return [pin for pin in (channel.enable, channel.first, channel.second) if pin is not None]


def channel_of(binding: migration.PortBinding, channels: Iterable[migration.MotorChannel]) -> migration.MotorChannel | None:
    """The channel that serves a port: the one with the port's pin at an input; None if there is none."""
    pin = bound_pin(binding)
    return next((channel for channel in channels if pin is not None and pin in inputs_of(channel)), None)


def free_motors(plan: migration.MigrationPlan, binding: migration.PortBinding) -> list[migration.Connection]:
    """The connections that a port of a servo may have to turn a motor: one for each complete channel that no other port has."""
    if binding.role != SERVO or without_motor(plan, binding):
        return []
    others = [other for other in plan.portBindings if other is not binding]
    free = [c for c in plan.motorChannels if not c.missing and all(channel_of(other, [c]) is None for other in others)]
    named = {id(connection.pin): connection for connection in plan.connections}
    return [named[id(pin)] for channel in free for pin in inputs_of(channel)[:1] if id(pin) in named]


def without_motor(plan: migration.MigrationPlan, binding: migration.PortBinding) -> str:
    """Why the functions at a port of a servo turn no motor in its place; empty if they do."""
    called = {str(call.calleeName) for call in port_calls(plan, binding)}
    for use in (use for use in plan.adapterUses if str(use.name) in called):
        pieces = closure([use.adapter]) if use.adapter is not None else []
        if use.function is not None and any(p.meaning is platform.Meaning.angle for p in use.function.parameters):
            return f"{use.name} sets an angle, and a motor has none"
        if any(_follows_an_angle(piece) for piece in pieces):
            return f"{use.name} needs the angle that a servo reports, and a motor reports none"
        if all(piece.name != MOTORS for piece in pieces):
            return f"the target has no adapter that drives a motor for {use.name}"
    return ""


def _follows_an_angle(piece: platform.Adapter) -> bool:
    """Whether a piece works with a servo that reports its angle."""
    roles = {str(pin.componentRole) for pin in piece.pins}
    return roles >= {SERVO, ENCODER} or any(port.componentRole == FEEDBACK for port in piece.ports)


def pins_for_motors(plan: migration.MigrationPlan) -> list[platform.Pin]:
    """The pins of all channels that serve a port of a servo."""
    turned = [channel_of(b, plan.motorChannels) for b in plan.portBindings if b.role == SERVO]
    return [pin for c in turned if c is not None for pin in (*inputs_of(c), c.awake) if pin is not None]


def servo_pins(
    channel: migration.MotorChannel, bindings: Iterable[migration.PortBinding]
) -> tuple[platform.Pin | None, platform.Pin | None, platform.Pin | None, platform.Pin | None, platform.Pin | None]:
    """The pins by which adapters drive a channel: the servo's, for PWM, for longer pulses than at a stand, for shorter, awake.

    The pin of the servo is that of the port which is bound to the channel, so that the numbers of the program lead there. If
    the servo at the port is mounted the other way round, shorter pulses are forward: the first direction input of the channel.
    """
    own = next((b for b in bindings if channel_of(b, [channel]) is not None), None)
    first, second = channel.first, channel.second
    if own is not None and own.mirrored:
        first, second = second, first
    return (bound_pin(own) if own is not None else inputs_of(channel)[0], channel.enable, first, second, channel.awake)
