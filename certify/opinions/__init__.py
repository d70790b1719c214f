"""Second derivations: the same verdicts by other roads.

Nothing here is trusted, and no theorem needs it; needs certify[search].
"""
