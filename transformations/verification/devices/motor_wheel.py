"""A wheel on a motor, which a channel of a motor driver turns, with an encoder at another pin."""

from __future__ import annotations

from robosmi.transformations.verification.devices.wheel import Wheel
from robosmi.verify.bench import Level

_WHOLE_US = 200.0
"""The microseconds by which a servo's pulse is longer or shorter than at a stand where the motor has full power."""
_SETTLES_US, _FRAME_US, _LASTS_US = 100.0, 20_000.0, 50_000.0


class MotorWheel(Wheel):
    """The wheel.

    It turns forward while `first` is high and `second` is low, and backward the other way round. The PWM is at `enable`, or at
    `first` and `second` if that is missing. Its speed is the duty cycle times the speed of a servo's wheel at pulses 200 us
    longer than at a stand. With both directions alike, without PWM, and while `awake` is low it stands. Settings as of `Wheel`.
    It notes each speed that lasts for 50 ms as `power`, in per cent of full power and negative backwards.
    """

    pin_names = ("first", "second")
    optional_pin_names = ("enable", "awake", "encoder")

    def start(self) -> None:
        """Stand still."""
        self._waves: dict[str, float] = {}
        self._share, self._told, self._settles = 0.0, 0, False
        super().start()
        self.bench.at(_FRAME_US, self._go_on)

    def pin_changed(self, pin: str, level: Level) -> None:
        """Take the level of an input."""
        self._changed()

    def wave_changed(self, pin: str, hz: float, duty: float) -> None:
        """Take the PWM at an input."""
        if hz:
            self._waves[pin] = duty
        else:
            self._waves.pop(pin, None)
        self._changed()

    def _changed(self) -> None:
        if not self._settles:
            self._settles = True
            self.bench.at(self.bench.now + _SETTLES_US, self._settle)

    def _settle(self) -> None:
        """Take the levels of all inputs: a program sets them one by one."""
        self._settles = False
        first, second = self._duty("first"), self._duty("second")
        share = first - second
        for name in ("enable", "awake"):
            share *= self._duty(name) if name in self.pins else 1.0
        if share == self._share:
            return
        self._share = share
        self.pulse(self.settings["neutral_us"] + _WHOLE_US * share)
        self.bench.at(self.bench.now + _LASTS_US, lambda: self._tell(share))

    def _duty(self, name: str) -> float:
        pin = self.pins[name]
        return self._waves.get(pin, 1.0 if self.bench.driven[pin] == 1 else 0.0)

    def _tell(self, share: float) -> None:
        """Note a speed if it has lasted."""
        if share == self._share and round(100 * share) != self._told:
            self._told = round(100 * share)
            self.note("power", self._told)

    def _go_on(self) -> None:
        """Say in each frame that the motor is driven, as pulses say it of a servo."""
        if self._share:
            self.pulse(self.settings["neutral_us"] + _WHOLE_US * self._share)
        self.bench.at(self.bench.now + _FRAME_US, self._go_on)

    @property
    def alone_us(self) -> float:
        """0: levels last."""
        return 0.0
