"""What the rule languages (EVL, ETL, EGX, Flock) share: options, guards, lazy rules, deep recursion.

`rule_language` runs rules as Epsilon's ERL does.
Imports `robosmi.query`; `validate`, `transform` and `generate` may import it.
"""
