"""The named workflows (chains): each runs readers, model-to-model and model-to-text transformations in sequence."""
