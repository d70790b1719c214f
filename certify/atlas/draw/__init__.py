"""Drawings: exact geometry, what is hidden, and pictures as SVG, PDF and PNG."""
