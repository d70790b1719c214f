"""The engineer's room: how good a hexahedron is; mesh files. No theorem depends on it."""
