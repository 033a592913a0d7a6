"""Libraries of the target: the ranking's data, and what libraries take of the board.

Imports `platforms`, the modules of `knowledge` and `robosmi.recommend`.
Rules and chains may import it.
"""
