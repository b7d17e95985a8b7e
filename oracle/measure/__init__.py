"""Error against run time and against stiffness: ways of casting over sets of rays, on one clock."""
