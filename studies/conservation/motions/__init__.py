"""conservation/motions"""
