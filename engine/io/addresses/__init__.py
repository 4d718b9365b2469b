"""Files at addresses, such as https://host/a.obj: names, bytes, and the files beside them."""
