"""Ranked retrieval with named criteria: which library of the target serves a component (paper, section 3.3).

`component` is the question, `ranking` the answer, `index` the files of libraries. `device_ranker` is the
default ranker, made of `tokens`, `lexicon`, `part_words`, `evidence` and `decision`; `tfidf_ranker` the paper's,
of `tfidf` and `ranking.utility`. `history` keeps earlier choices. Which libraries and devices there are is data and is found by
`robosmi.transformations`. Nothing is imported here, so that `import robosmi` stays quick.
"""
