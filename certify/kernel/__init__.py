"""The trusted part: whatever this package accepts is proved, whoever wrote the certificate.

Standard library and sympy only; nothing outside this package is imported. Its own door is
``python -m certify.kernel [ROOT]``. Read the modules in this order: hexahedron, triangulation,
chirotope, embedding, jacobian, orientations, refutation, validity, completeness, evidence,
certificate, check, names, cube, theorems.
"""
