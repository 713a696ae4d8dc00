"""Task panels: what a user sees while making or changing an object."""
