"""Where a ray is inside a solid, exactly: in integers, and no float decides anything."""
