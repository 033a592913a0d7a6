"""Devices behind the `Device` interface of `robosmi.verify.bench`, one module each."""
