"""noise/dpd"""
