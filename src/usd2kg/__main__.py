"""The command line without its script: `python -m usd2kg`."""

from usd2kg.cli.app import main

if __name__ == "__main__":
    main()
