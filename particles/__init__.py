"""Particle methods for fluids: weights, pair sums, walls, methods, and the only time loop."""
