"""The reader's room: refutations in words, drawings, and a page for each pattern."""
