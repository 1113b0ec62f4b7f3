"""Small glTF files and what they must bake to, one file for each part of the format."""
