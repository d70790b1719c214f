"""Answers explained: a no in steps that the kernel replays, a yes as a page to check by hand."""
