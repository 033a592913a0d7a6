"""The examples of the documentation; the line follower is installed with the package, for the command `demo`."""
