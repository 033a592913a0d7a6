"""Which channel of a motor driver serves a port of a servo, and on which pins: those of the plan's channels."""

from __future__ import annotations

from collections.abc import Iterable

from robosmi.metamodels import migration, platform
from robosmi.transformations.queries.plans.port_pins import bound_pin

SERVO = "servo"
"""The kind of component that a port of a servo expects, as the repository's data call it."""


def inputs_of(channel: migration.MotorChannel) -> list[platform.Pin]:
    """The pins at the inputs of a channel, without the one for standby."""
    return [pin for pin in (channel.enable, channel.first, channel.second) if pin is not None]


def channel_of(binding: migration.PortBinding, channels: Iterable[migration.MotorChannel]) -> migration.MotorChannel | None:
    """The channel that serves a port: the one with the port's pin at an input; None if there is none."""
    pin = bound_pin(binding)
    return next((channel for channel in channels if pin is not None and pin in inputs_of(channel)), None)


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
