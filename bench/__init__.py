"""Speed, beside public codes, in one run."""
