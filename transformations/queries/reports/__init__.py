"""What a plan amounts to: work that is left, analysis of a program, what a board must have.

These are the queries that reports, the terminal and the page show.
Imports the other rooms of `queries`; chains and generators import it.
"""
