"""`python -m crustline` is the command `crustline`."""

from crustline.cli import main

if __name__ == "__main__":
    main()
