"""Content for running programs: simulators (`engines`) and what is connected to their pins (`devices`)."""
