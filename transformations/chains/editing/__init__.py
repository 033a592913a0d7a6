"""What an editor shows while a person edits the files beside a program: findings, completions, choices to make."""
