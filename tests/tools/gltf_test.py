"""Tests of glTF files, made by baking small ones: python3 gltf_test.py ESPALIER [FOLDER_TO_KEEP_FILES_IN [PART...]]

Each file is made here, and so are the triangles that it describes, in Python's own numbers.
"""
from gltf.checks import run_parts
from gltf.compression import draco, gltfpack, meshopt
from gltf.container import containers, extensions, hostile, restarts, tiles
from gltf.deformation import deformation
from gltf.geometry import positions, topology
from gltf.scene import instances, nodes, scenes
from gltf.skin import morphs, skins

if __name__ == "__main__":
    run_parts(containers, tiles, topology, positions, nodes, scenes, skins, morphs, instances, meshopt, draco, restarts, extensions, hostile, gltfpack, deformation)
