"""Discretized integral hydrodynamics: points, edges and the equations over them    [RR98]"""
