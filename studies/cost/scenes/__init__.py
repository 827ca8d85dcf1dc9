"""cost/scenes"""
