"""Options shared by several commands, and bundles of options that set up one step."""
