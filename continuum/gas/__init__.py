"""The compressible gas on a grid    [KHP95, Sec. V]"""
