"""Skins and morph targets."""
import math

from .builder import *
from .checks import *


def skin_file(weights, joints=None, weights_component=FLOAT, matrices=True, **rest):
    """Joint 1 stands 5 up, joint 2 stands 2 to the right of it; the mesh's own node stands elsewhere."""
    gltf = Gltf()
    primitive = solid_primitive(gltf)
    joints = joints or [[0, 1, 0, 0]] * 4
    primitive["attributes"]["JOINTS_0"] = gltf.accessor(joints, UNSIGNED_BYTE)
    primitive["attributes"]["WEIGHTS_0"] = gltf.accessor(weights, weights_component, weights_component != FLOAT)
    gltf.node(mesh=gltf.mesh(primitive), skin=0, translation=[100, 0, 0])
    gltf.node(translation=[0, 5, 0], children=[2], **rest)
    gltf.node(translation=[2, 0, 0], rotation=quaternion_about_z(90))
    gltf.json["skins"] = [{"joints": [1, 2]}]
    if matrices:
        bind = [columns(scaled(2, 2, 2)), columns(moved(0, 0, 1))]
        gltf.json["skins"][0]["inverseBindMatrices"] = gltf.accessor(bind)
    return gltf


def blended(weights, joints):
    return [tuple(sum(w * applied(j, p)[i] for w, j in zip(row, joints)) / sum(row) for i in range(3))
            for p, row in zip(POINTS, weights)]


def skins():
    first, second = moved(0, 5, 0), times(moved(2, 5, 0), turned_about_z(90))
    bound = [times(first, scaled(2, 2, 2)), times(second, moved(0, 0, 1))]
    claim("a skinned mesh stands where its joints are, and not where its node is; with a warning")
    warned(bakes(skin_file([[1, 0, 0, 0]] * 4), solid(bound[0])), "skinned_mesh")
    bakes(skin_file([[1, 0, 0, 0]] * 4, matrices=False), solid(first))
    claim("a vertex between joints is their mean by weights, in every type of weights")
    weights = [[1, 0, 0, 0], [0.25, 0.75, 0, 0], [0, 1, 0, 0], [0.5, 0.5, 0, 0]]
    bakes(skin_file(weights), solid(points=blended(weights, bound)))
    for component, largest in ((UNSIGNED_BYTE, 255), (UNSIGNED_SHORT, 65535)):
        whole = [[round(w * largest) for w in row] for row in weights]
        bakes(skin_file(whole, weights_component=component), solid(points=blended(whole, bound)))
    claim("weights that do not add up to 1 are scaled, and a vertex without weights stays")
    bakes(skin_file([[2 * w for w in row] for row in weights]), solid(points=blended(weights, bound)))
    points = blended([[1, 0]] * 4, bound)
    points[3] = POINTS[3]
    bakes(skin_file([[1, 0, 0, 0]] * 3 + [[0, 0, 0, 0]]), solid(points=points))
    claim("a mirrored joint keeps the front outside")
    bakes(skin_file([[1, 0, 0, 0]] * 4, scale=[-1, 1, 1]),
          solid(times(times(first, scaled(-1, 1, 1)), scaled(2, 2, 2)), mirrored=True))
    claim("a joint that the skin lacks is refused, unless its weight is 0")
    refused(skin_file(weights, joints=[[0, 1, 0, 0]] * 3 + [[0, 9, 0, 0]]), 3, "primitive 0", "joint 9")
    bakes(skin_file(weights, joints=[[0, 1, 9, 9]] * 4), solid(points=blended(weights, bound)))
    claim("a weight that is negative or no number is refused with its vertex")
    for weight in (-0.5, -math.inf, math.inf, math.nan):
        refused(skin_file([[1, 0, 0, 0]] * 2 + [[0.5, weight, 0, 0]] + [[1, 0, 0, 0]]), 3, "primitive 0", "weight of vertex 2")
    claim("an inverse bind matrix whose last row is not 0 0 0 1 is refused with its number")
    for entry, value in ((3, 1.0), (7, 0.5), (11, math.nan), (15, 2.0)):
        gltf = skin_file(weights, matrices=False)
        bind = [columns(scaled(2, 2, 2)), columns(moved(0, 0, 1))]
        bind[1][entry] = value
        gltf.json["skins"][0]["inverseBindMatrices"] = gltf.accessor(bind)
        refused(gltf, 3, "skin 0", "inverse bind matrix 1", "0 0 0 1")
    claim("a mesh without joints and weights on a node with a skin stands where its node is; with a warning")
    gltf = changed(skin_file(weights), "meshes.0.primitives.0.attributes.JOINTS_0")
    warned(bakes(gltf, solid(moved(100, 0, 0))), "unweighted_mesh")


def morphs():
    claim("morph targets move vertices by the weights of the mesh, or of the node, or not at all; with a warning")
    up, right = [(0.0, 1.0, 0.0)] * 4, [(0.5, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.25), (1.0, 0.0, 0.0)]
    for mesh_weights, node_weights, expected in ((None, None, (0, 0)), ([1, 0.5], None, (1, 0.5)), ([1, 0.5], [0, 2], (0, 2))):
        gltf = Gltf()
        # The second target is sparse above nothing, as exporters write it.
        targets = [{"POSITION": gltf.accessor(up)},
                   {"POSITION": gltf.accessor(up, view=False, sparse=([0, 2, 3], [right[0], right[2], right[3]], UNSIGNED_BYTE))}]
        mesh = gltf.mesh(solid_primitive(gltf, targets=targets))
        if mesh_weights:
            gltf.json["meshes"][0]["weights"] = mesh_weights
        gltf.node(mesh=mesh, **({"weights": node_weights} if node_weights else {}))
        points = [tuple(p[i] + expected[0] * u[i] + expected[1] * r[i] for i in range(3)) for p, u, r in zip(POINTS, up, right)]
        warned(bakes(gltf, solid(points=points)), "morphed_mesh")
    claim("a target of normalised integers is scaled")
    gltf = Gltf()
    target = gltf.accessor([(127, 0, 0)] * 4, BYTE, True, 4)
    gltf.node(mesh=gltf.mesh(solid_primitive(gltf, targets=[{"POSITION": target}]), weights=[2.0]))
    bakes(gltf, solid(moved(2, 0, 0)))
