"""Small files of each format, written here, and what the command must read in them."""
