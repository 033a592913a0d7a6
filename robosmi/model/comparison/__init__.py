"""Comparison of two models: which elements of one are which of the other, and what is different about them.

`comparison` is the way in; `matching` finds the pairs, `facts` says what is compared of an element. `merging` is the way in
to the three-way merge: `versions` has the elements of three models, `merged_places` and `merged_features` decide about them, and
`merged_model` applies what they decide.
Imports the other rooms of `robosmi.model`; none of them imports it.
"""
