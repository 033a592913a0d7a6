"""Simulators behind the `Engine` interface of `robosmi.verify.simulation`, one module each; none is part of this package."""
