"""Coverage-guided fuzzing of everything that the kernel reads."""
