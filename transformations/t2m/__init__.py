"""Text to model: readers of programs, drawings and the platform repository."""
