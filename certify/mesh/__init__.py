"""The engineer's room: how good a hexahedron is. No theorem depends on it."""
