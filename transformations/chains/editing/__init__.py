"""What an editor shows while the user edits the files beside a program: findings, completions, choices to make."""
