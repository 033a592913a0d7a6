"""The metamodels (.ecore) and one package generated from each."""
