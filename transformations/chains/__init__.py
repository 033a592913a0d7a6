"""The named workflows: each puts readers, model-to-model and model-to-text transformations in a row."""
