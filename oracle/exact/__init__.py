"""Where a ray is inside a solid, exactly: integers and one power of two, no float decides anything."""
