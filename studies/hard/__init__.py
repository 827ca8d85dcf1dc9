"""Hard cases: what freezes, pairs, clumps, rings or diverges, and what was predicted."""
