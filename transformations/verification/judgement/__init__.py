"""The verdict on a scenario: compared channels, unexpected signals, coverage of the source, calls to blame.

`verdict` decides on one scenario, `scenario_verdicts` on all; `evidence` says what the verdict rests on.
Imports the runs of `verification`; the chain `verify` imports it.
"""
