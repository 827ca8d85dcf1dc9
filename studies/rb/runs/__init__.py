"""What is computed: one run of a method in the layer or the box, and what a step costs."""
