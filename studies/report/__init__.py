"""One page of everything in results/: findings, verdicts, figures with their tables, cost against error, films."""
