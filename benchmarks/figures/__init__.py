"""What is measured: one module a subject, each of which registers its figures (see `registry`)."""
