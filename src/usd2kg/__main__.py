"""Run the command line as `python -m usd2kg`."""

from usd2kg.cli.app import main

if __name__ == "__main__":
    main()
