"""Redraw the paper's figures and the README's picture: python -m figures [NAME ...]

Writes docs/gallery/*.png and docs/gallery/README.md. Everything drawn is computed by crustline; the
point sets are our own. The same versions of matplotlib and NumPy write the same bytes again.
"""

import sys

from figures.gallery import write

if __name__ == "__main__":
    write(sys.argv[1:])
