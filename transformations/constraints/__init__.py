"""Constraints on code, hardware and plan models, in the manner of EVL: each with an id, severity, check, message and, where
known, a fix.

`robosmi check` runs those of a model's metamodel (the registry's kind "constraints", by the metamodel's name). Each has one
passing and one failing example in the tests. Findings of readers and generators are theirs, not here.
"""
