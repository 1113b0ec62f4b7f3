"""Tests of scenes: python3 scene_test.py ESPALIER [FOLDER_TO_KEEP_FILES_IN [PART...]]

The files are made here, and scenes are read back in Python.
"""
from gltf.checks import run_parts
from scene.baking import automatic, borders, many, places, repeats, tolerances, variants
from scene.pairs import pairs
from scene.verbs import broken, listings, policies, queries

if __name__ == "__main__":
    run_parts(places, variants, repeats, automatic, borders, tolerances, many, queries, pairs, listings, broken, policies)
