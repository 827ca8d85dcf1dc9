"""operators/transport"""
