"""hardcases/interface"""
