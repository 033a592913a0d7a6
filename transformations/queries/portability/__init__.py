"""Places of a program that may behave otherwise on another board.

`places` puts the kinds together, each a rule of its own over the code model; `names` and `pin_origins` are what they share.
"""
