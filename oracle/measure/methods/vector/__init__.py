"""Methods that answer all lanes at once, in arrays of NumPy; nothing outside loads them early."""
