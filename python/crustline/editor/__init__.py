"""The editor: draw and drag points, and see their curves, in a browser or a notebook.

`crustline edit` serves the page; `curves.edit()` and `widget(points)` put it into a notebook. The
curves that it shows are computed in the browser, by the same core compiled to WebAssembly; what a
program gets back, and what is saved in the library's formats, is computed by the library.
"""

from crustline.editor.widget import widget

__all__ = ["widget"]
