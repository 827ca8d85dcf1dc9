"""noise/fluctuations"""
