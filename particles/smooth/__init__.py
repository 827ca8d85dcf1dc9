"""Smooth-particle applied mechanics    [KHP95]"""
