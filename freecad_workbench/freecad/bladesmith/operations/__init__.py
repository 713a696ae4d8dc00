"""What Bladesmith does, once for command line and window: core and Open CASCADE joined."""
