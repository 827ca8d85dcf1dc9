"""Steady convection by a spectral method, whose error falls exponentially: the reference for all methods.

    state = steady(GasLaws(RayleighBenard(ra=1e4)), 24)         # of `newton`, `laws`
    state.K, state.Nu
"""
