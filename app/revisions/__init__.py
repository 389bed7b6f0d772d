"""Settings that are kept revision by revision: adopted by the loop whole or not at all, and only then stored."""
