"""Scenes: which meshes become instances, and what the verbs answer."""
