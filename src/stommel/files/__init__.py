"""Files from outside and files written: fields with ranges, units, provenance, sentences of errors, whole writing."""
