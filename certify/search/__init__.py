"""The untrusted part: finds the certificates that the kernel checks. Needs ``certify[search]``."""
