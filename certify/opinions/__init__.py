"""Second derivations: the same verdicts by other roads.

Nothing here is trusted, and no theorem needs it. Part of it needs certify[search]; ``balls``,
``planes`` and ``bounds`` need the standard library alone, and nothing of the kernel.
"""
