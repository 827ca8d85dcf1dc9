"""Fluids as particles: weights, pair sums, walls, methods and the one time loop."""
