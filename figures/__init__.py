"""The pictures of the pages, drawn by crustline itself."""
