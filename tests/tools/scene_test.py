"""Tests of scenes: python3 scene_test.py ESPALIER [FOLDER_TO_KEEP_FILES_IN [PART...]]

The files are made here, and scenes are read back in Python.
"""
import os
import sys
import tempfile

from gltf.checks import summary
from scene.baking import automatic, borders, many, places, repeats, tolerances, variants
from scene.pairs import pairs
from scene.verbs import broken, listings, policies, queries


def main():
    folder = sys.argv[2] if len(sys.argv) > 2 else None
    with tempfile.TemporaryDirectory() as temporary:
        os.chdir(folder or temporary)
        for part in (places, variants, repeats, automatic, borders, tolerances, many, queries, pairs, listings, broken,
                     policies):
            if len(sys.argv) < 4 or part.__name__ in sys.argv[3:]:
                part()
        os.chdir("/")
    return summary()


if __name__ == "__main__":
    sys.exit(main())
