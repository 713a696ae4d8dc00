"""How document objects look in the tree and in the 3-D view."""
