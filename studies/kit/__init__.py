"""What all studies share: cases on workers, tables, claims, figures."""
