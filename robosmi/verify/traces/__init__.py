"""Traces compared: activities of pins, pulses, servo frames, tolerances, and the verdict.

`comparison` compares two channels, `verdict` sums up all scenarios, `vcd` and `trace_picture` show them.
Imports `robosmi.verify`; the content's `verification` and the command line may import it.
"""
