"""hardcases/map"""
