"""Constraints on code, hardware and plan models in the style of EVL: id, severity, check, message and, where possible, a fix.

`robosmi check` evaluates those of a model's metamodel (the registry's kind "constraints", by the metamodel's name). The tests
have a passing and a failing example for each. Findings of readers and generators are defined there, not here.
"""
