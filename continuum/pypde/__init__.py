"""Convection again, solved with py-pde."""
