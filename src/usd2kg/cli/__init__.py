"""The command line. Each command checks its arguments, calls the library and prints."""
