"""Ranked retrieval with named criteria: which library of the target serves a component (paper, section 3.3).

`component` is the question, `index` the file of libraries, `tfidf` the paper's equation, `history` earlier choices,
`ranking` the utility function and the answer, `tfidf_ranker` the ranker made of these. Which libraries there are is
data and is found by `robosmi.transformations`. Nothing is imported here, so that `import robosmi` stays quick.
"""
