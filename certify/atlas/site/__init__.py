"""The atlas as a static site: records of one run, templates, and a little JavaScript."""
