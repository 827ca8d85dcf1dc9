"""hardcases/tube"""
