"""The search for scenarios: inputs, thresholds, hysteresis, combinations, within a budget.

`scenario_search` runs the stages, `scenario_trials` runs the source program.
Imports the runs of `verification` and `bound_devices`; the chain `verify` imports it.
"""
