"""Migrations of models that older versions of RoboSMi stored; the metamodels of those versions lie beside them."""
