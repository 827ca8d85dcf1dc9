"""How good is a method of one's own? A ladder of scenes, and one page of verdicts.

    python -m studies.judge my_module:MyMethod

The scenes have known answers; `studies.front.solve` runs them. `examples/your_method.md` shows such a class.
"""
