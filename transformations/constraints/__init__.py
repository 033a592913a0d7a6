"""EVL-style constraints on the models; each has an id, a severity, a check, a message and advice."""
