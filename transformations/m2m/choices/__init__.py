"""Choices: stored ones that still hold, checks of an edited plan, libraries (paper, section 3.3).

Imports queries and knowledge.
The plan and the chain import it.
"""
