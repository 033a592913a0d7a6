"""Moves a program whose platform stays: another board of the same platform, where a name means the same.

The text stays as it is, but for what behaves differently on the other board: `sketch_rules` lists the rules that change such
places, `retained_platform` gives each element of the program its disposition.
"""
