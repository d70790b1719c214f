"""Forgeries thrown at the kernel; what it accepts has to be true by other means.

Each forgery is refused, or something of it is accepted that is true, or something that is false;
and then the kernel is wrong. A change need not make a claim false: another triangulation is one,
and points have room to move. :mod:`campaign` makes the forgeries, :mod:`judge` judges them, and
:mod:`kinds` lists the kinds.
"""
