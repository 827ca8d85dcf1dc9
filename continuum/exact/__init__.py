"""What is known in closed form."""
