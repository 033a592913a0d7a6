"""Model to model: from code, hardware and platform models to the migration plan."""
