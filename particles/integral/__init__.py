"""Discretized integral hydrodynamics: points, edges, and exchange over edges    [RR98]"""
