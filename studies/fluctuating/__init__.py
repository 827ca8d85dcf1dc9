"""What the study of fluctuations is made of: algebra, flows, steps in time, samples; tables, figures, claims."""
