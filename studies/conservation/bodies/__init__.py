"""conservation/bodies"""
