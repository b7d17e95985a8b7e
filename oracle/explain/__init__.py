"""One case derived in the seed's own steps: as data, and as text."""
