"""Particle methods: the stages of a paper's scheme, in its order."""
