"""Commands of toolbar and menu, each named ``Bladesmith_<Name>``."""
