"""The text of exported scripts, one module after the other; see `frame`."""
