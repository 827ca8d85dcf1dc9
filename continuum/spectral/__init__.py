"""Steady convection by a spectral method, whose error falls exponentially: a truth for all other methods.

    state = steady(GasLaws(RayleighBenard(ra=1e4)), 24)         # of `newton`, `laws`
    state.K, state.Nu
"""
