"""From a client and a corpus to a certificate: run, grade, verdict, diagnosis."""
