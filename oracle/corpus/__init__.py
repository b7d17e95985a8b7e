"""From questions to golden rows: written, checked, drawn fresh, adopted."""
