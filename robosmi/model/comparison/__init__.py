"""Comparison of two models: which elements of one are which of the other, and what is different about them.

`comparison` is the way in; `matching` finds the pairs, `facts` says what is compared of an element. `merging` is the way in
to the three-way merge: `versions` has the elements of three models.
Imports the other rooms of `robosmi.model`; none of them imports it.
"""
