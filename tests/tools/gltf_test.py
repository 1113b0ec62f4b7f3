"""Tests of glTF files, made by baking small ones: python3 gltf_test.py ESPALIER [FOLDER_TO_KEEP_FILES_IN [PART...]]

Each file is made here, and so are the triangles that it describes, in Python's own numbers.
"""
import os
import sys
import tempfile

from gltf.checks import summary
from gltf.compression import draco, gltfpack, meshopt
from gltf.container import containers, extensions, hostile, restarts
from gltf.deformation import deformation
from gltf.geometry import positions, topology
from gltf.scene import instances, nodes, scenes
from gltf.skin import morphs, skins


def main():
    folder = sys.argv[2] if len(sys.argv) > 2 else None
    with tempfile.TemporaryDirectory() as temporary:
        os.chdir(folder or temporary)
        for part in (containers, topology, positions, nodes, scenes, skins, morphs, instances, meshopt, draco, restarts, extensions,
                     hostile, gltfpack, deformation):
            if len(sys.argv) < 4 or part.__name__ in sys.argv[3:]:
                part()
        os.chdir("/")
    return summary()


if __name__ == "__main__":
    sys.exit(main())
