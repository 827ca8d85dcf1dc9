"""operators/nested"""
