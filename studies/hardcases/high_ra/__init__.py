"""hardcases/high_ra"""
