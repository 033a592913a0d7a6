"""Port binding: which pin of the new board serves which port of the program (paper, Listing 3).

`port_binding` is the rule, `port_evidence` scores, `port_texts` edits the places.
Imports `choices`, queries and knowledge; `partition` and the chain import it.
"""
