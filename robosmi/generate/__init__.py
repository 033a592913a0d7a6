"""Model to text: the template environment, generated files with their traces, and the manifest that guards a person's edits.

A first part of the EGL/EGX mirror (its own issue completes it). Templates hold no logic; what they show is prepared by
the model-to-text transformations. Nothing here knows what is generated.
"""
