"""One page of what is in results/: findings, verdicts, error against cost, films, figures."""
