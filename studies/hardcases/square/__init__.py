"""hardcases/square"""
