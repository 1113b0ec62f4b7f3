"""Readers of mesh formats, written from the formats' specifications: what the tests compare the command with."""
