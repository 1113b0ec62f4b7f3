"""Espalier in place of trimesh's back ends: rays, proximity and collisions, by trimesh's names and arguments.

    import trimesh, espalier.trimesh
    espalier.trimesh.install()                     # every mesh that is made from now on; uninstall() ends it
    mesh.ray.intersects_location(ray_origins=origins, ray_directions=directions)

    mesh.ray = espalier.trimesh.RayMeshIntersector(mesh)              # or of one mesh
    baked = espalier.trimesh.bake_trimesh(mesh, origin=o)             # or of a bake of your own
    espalier.trimesh.ProximityQuery(baked).signed_distance(points)

A mesh is anything with `vertices` and `faces`; only install() needs trimesh itself. A mesh is baked when it is first
queried, and a mesh of trimesh again after it was changed. Coordinates are those of the mesh, in float64: espalier finds
the triangles, and places and distances are computed on those of the mesh, in float64.
"""

from .baked_mesh import BakedMesh, bake_trimesh
from .collision import CollisionManager, ContactData, DistanceData
from .proximity import ProximityQuery, closest_point, signed_distance
from .ray import RayMeshIntersector
from .replacing import install, uninstall

__all__ = ["BakedMesh", "CollisionManager", "ContactData", "DistanceData", "ProximityQuery", "RayMeshIntersector",
           "bake_trimesh", "closest_point", "install", "signed_distance", "uninstall"]
