"""The verdict on a scenario: compared channels, unexpected signals, coverage of the source, calls to blame.

`verdict` decides on one scenario, `scenario_verdicts` on all.
Imports the runs of `verification`; the chain `verify` imports it.
"""
