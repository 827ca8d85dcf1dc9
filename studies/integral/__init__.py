"""Discretized integral hydrodynamics under test    [RR98]"""
