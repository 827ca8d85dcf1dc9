"""Cases, tables, figures and claims on convection, shared by the studies `rb` and `onset`."""
