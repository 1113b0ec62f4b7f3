"""Espalier: baked collision meshes, queried straight from their bytes.

    import numpy as np, espalier
    blob = espalier.bake(positions, triangles, original_ids=True)     # or espalier.open_blob("level.espl")
    hits = blob.raycast(origins, directions)                          # (n, 3) float32, no copies
    hits["t"], hits["normal"], hits["triangle"], hits["status"] == espalier.Status.OK

Arguments are NumPy arrays of real numbers with any strides, or anything that becomes one, and broadcast against each
other. float32 is used where it lies if the three numbers of a vector are adjacent; all else is converted to float32
once, each number rounded to the nearest; of places after the origin of the blob, if it has one, was subtracted in
float64. Results are arrays in the common shape of the arguments, of structured types
or lists of them. Every result has a status, and errors of single queries never raise.
"""

from types import ModuleType as _ModuleType

from . import pairs
from ._core import version as __version__
from .baking import BakeWarning, bake, bake_file, bake_meshes
from .blob import Blob, Refitted, join_borders, open_blob, read_remap, verify
from .bounds import Slabs
from .edges import reduce_contacts
from .errors import BakeError, MeshFileError, OpenError
from .mesh_files import Mesh, MeshFile, MeshFileWarning, SourceNames, read_mesh
from .moving_scenes import MovingScene, Pairs, open_moving_scene
from .pictures import pinhole, png_of, write_png
from .points import solve_planes
from .results import (
    BAKED_PAIR,
    BLOB_DISTANCE,
    BOX,
    CANDIDATE,
    CLOSEST_POINT,
    CONTACT,
    CONTACT_PLANE,
    DISTANCE_BOUNDS,
    EDGE_KINDS,
    HANDLE,
    INSTANCE,
    INSTANCE_PAIR,
    LENGTH,
    NO_TRIANGLE,
    ORIGINAL_HIT,
    ORIGINAL_TRIANGLE,
    PAIR_CONTACT,
    PAIR_TOUCH,
    RAY_HIT,
    REMAP,
    SCENE_CLOSEST_POINT,
    SCENE_CONTACT,
    SCENE_RAY_HIT,
    SCENE_SWEEP_HIT,
    SCENE_TRIANGLE,
    SWEEP_HIT,
    WAY,
    WINDING,
    EdgeKind,
    Feature,
    Lists,
    Side,
    SourceHits,
    Status,
    YesNo,
)
from .scenes import Scene, bake_scene, open_scene, verify_scene
from .shapes import Box, Capsule, Cone, ConvexHull, ConvexVolume, OrientedBox, Ray, Segment, Sphere, Triangle
from .transforms import (
    direction_to_local,
    direction_to_world,
    normal_to_world,
    to_local,
    to_world,
    transform,
    transform_from_matrix,
)
from .voxels import VoxelGrid, voxel_grid

__all__ = [name for name, value in globals().items()
           if not name.startswith("_") and (name == "pairs" or not isinstance(value, _ModuleType))] + ["__version__"]
