"""hardcases/limits"""
