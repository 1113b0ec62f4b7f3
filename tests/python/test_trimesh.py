"""espalier.trimesh, by meshes that have what those of trimesh have: it needs no trimesh."""

import types

import numpy as np
import pytest

import espalier
import espalier.trimesh
from conftest import raises


class Mesh:
    """Vertices and faces whose hash is that of their content, as that of a mesh of trimesh is."""

    def __init__(self, vertices, faces):
        self.vertices, self.faces = np.array(vertices, float), np.array(faces, int)

    def __hash__(self):
        return hash((self.vertices.tobytes(), self.faces.tobytes()))


def box(low=(-0.5, -0.5, -0.5), high=(0.5, 0.5, 0.5)):
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
    faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
             [1, 5, 7], [1, 7, 3]]
    return Mesh(np.array(low) + corners * (np.array(high) - low), faces)


@pytest.fixture
def thing(mesh):
    return Mesh(*mesh)


def test_rays_have_the_names_and_types_of_trimesh(thing, random):
    rays = espalier.trimesh.RayMeshIntersector(thing)
    origins, targets = random.uniform(-6, 6, (500, 3)), random.uniform(-3, 3, (500, 3))
    directions = 0.25 * (targets - origins)
    first = rays.intersects_first(ray_origins=origins, ray_directions=directions)
    np.testing.assert_array_equal(rays.intersects_any(ray_origins=origins, ray_directions=directions), first >= 0)
    faces, numbers, places = rays.intersects_id(origins, directions, return_locations=True, multiple_hits=False)
    assert faces.dtype == numbers.dtype == first.dtype == np.int64 and places.dtype == np.float64
    np.testing.assert_array_equal(faces, first[numbers])
    corners = thing.vertices[thing.faces[faces]]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    assert np.abs(np.einsum("ij,ij->i", places - corners[:, 0], normals)).max() < 1e-12  # on the faces of the mesh
    way = places - origins[numbers]
    assert np.abs(np.cross(way, directions[numbers])).max() < 1e-9                       # and on the rays
    assert len(rays.intersects_id(origins, directions)) == 2
    many = rays.intersects_location(origins, directions)
    assert many[0].shape == (len(many[1]), 3) and (np.diff(many[1]) >= 0).all()
    odd = np.bincount(many[1], minlength=500) % 2 == 1
    np.testing.assert_array_equal(odd, rays.contains_points(origins))
    with pytest.raises(ValueError, match=r"\(n,3\)"):
        rays.contains_points([0, 0, 0])


def test_an_edge_or_a_corner_counts_once():
    cube = box()
    rays = espalier.trimesh.RayMeshIntersector(cube)
    _, numbers, _ = rays.intersects_location(np.zeros((8, 3)), cube.vertices)
    np.testing.assert_array_equal(np.bincount(numbers), np.ones(8))
    _, numbers = rays.intersects_id([[0, 0, -5]] * 2, [[0, 0, 1], [0, 1, 0]])
    assert numbers.tolist() == [0, 0]  # the diagonals of two sides


def test_a_ray_from_the_surface_hits_it_and_the_other_side():
    rays = espalier.trimesh.RayMeshIntersector(box())
    places, _, _ = rays.intersects_location([[0.1, 0.2, 0.5]], [[0, 0, -3]])
    np.testing.assert_allclose(places, [[0.1, 0.2, 0.5], [0.1, 0.2, -0.5]], atol=1e-12)
    assert rays.intersects_first([[0.1, 0.2, 0.5001]], [[0, 0, 1]]).tolist() == [-1]
    far = rays.intersects_location([[0.1, 0.2, -1e9]], [[0, 0, 1.0]])[0]
    np.testing.assert_allclose(far[:, 2], [-0.5, 0.5], atol=1e-6)


@pytest.mark.parametrize("offset", [0.0, 5e6])
def test_origins_are_honoured(offset):
    """Of coordinates that float32 does not hold, by default and with an origin of the caller's."""
    cube = box(np.array([-0.5] * 3) + offset, np.array([0.5] * 3) + offset)
    for given in (cube, espalier.trimesh.bake_trimesh(cube, origin=[offset - 3] * 3)):
        rays, query = espalier.trimesh.RayMeshIntersector(given), espalier.trimesh.ProximityQuery(given)
        places, _, _ = rays.intersects_location(np.array([[0.1, 0.2, -9.0]]) + offset, [[0, 0, 1]])
        np.testing.assert_allclose(places - offset, [[0.1, 0.2, -0.5], [0.1, 0.2, 0.5]], atol=1e-6)
        closest, distance, _ = query.on_surface(np.array([[0.1, 0.2, 0.75]]) + offset)
        np.testing.assert_allclose(closest - offset, [[0.1, 0.2, 0.5]], atol=1e-6)
        np.testing.assert_allclose(distance, 0.25, atol=1e-6)
        np.testing.assert_allclose(query.signed_distance(np.array([[0.1, 0.2, 0.4], [0.1, 0.2, 0.8]]) + offset), [0.1, -0.3],
                                   atol=1e-6)
        assert rays.contains_points(np.array([[0, 0, 0], [0, 0, 1]]) + offset).tolist() == [True, False]


def test_collisions_far_from_zero():
    """In UTM, with places that keep the fractions of a millimetre."""
    place, unit = np.array([500123.4567, 5400321.123, 612.3]), np.full(3, 0.5)
    cube, other = box(place - unit, place + unit), box(-unit, unit)
    manager = espalier.trimesh.CollisionManager()
    manager.add_object("far", cube)
    at = np.eye(4)
    at[:3, 3] = place + [1.25, 0, 0]
    distance, data = manager.min_distance_single(other, at, return_data=True)
    assert abs(distance - 0.25) < 1e-5 and not manager.in_collision_single(other, at)
    np.testing.assert_allclose([data.point("far")[0], data.point("__external")[0]], place[0] + [0.5, 0.75], atol=1e-5)
    at[0, 3] -= 0.26
    collides, contacts = manager.in_collision_single(other, at, return_data=True)
    assert collides and all(np.abs(contact.point - place).max() < 2 for contact in contacts)
    assert espalier.trimesh.bake_trimesh(cube, origin="auto").origin.any()


def test_closest_points_are_those_of_all_faces(thing, random):
    points = np.concatenate([random.uniform(-5, 5, (200, 3)), random.uniform(-1e6, 1e6, (5, 3)), [[0, 0, 0], [1e12, 0, 0]]])
    closest, distance, face = espalier.trimesh.closest_point(thing, points)
    assert face.dtype == np.int64
    for point, place, length, number in zip(points, closest, distance, face):
        corners = thing.vertices[thing.faces]
        everywhere = espalier.trimesh.geometry.closest_points(corners, np.tile(point, (len(corners), 1)))
        squared = ((everywhere - point) ** 2).sum(axis=1)
        assert abs(length - np.sqrt(squared.min())) <= 1e-8 + 1e-12 * length
        assert squared[number] <= squared.min() + 1e-8 + 1e-12 * length**2
        np.testing.assert_allclose(place, everywhere[number], atol=1e-9 * max(1, length))
    nothing = espalier.trimesh.closest_point(thing, [[np.nan, 0, 0]])
    assert np.isnan(nothing[0]).all() and np.isnan(nothing[1]).all() and nothing[2].tolist() == [-1]


def test_ties_go_to_the_face_that_faces_the_point():
    """Two faces of an acute edge, which the closest point lies on: trimesh takes the one that looks at the point."""
    wedge = Mesh([[-1, 0.5, 0], [1, 0.5, 0], [0, -1, -0.5], [0, -1, 0.5]], [[0, 1, 2], [0, 2, 3], [0, 3, 1], [3, 2, 1]])
    points = np.stack([np.zeros(20), np.ones(20), np.linspace(-1, 1, 20)], axis=-1)
    _, _, faces = espalier.trimesh.ProximityQuery(wedge).on_surface(points)
    assert len(set(faces[:10])) == len(set(faces[10:])) == 1 and faces[0] != faces[-1]


def test_open_surfaces_answer_by_their_winding(mesh):
    holed = Mesh(mesh[0], mesh[1][5:])
    inside = espalier.trimesh.RayMeshIntersector(holed).contains_points([[3, 0, 0], [-3, 0, 0], [0, 0, 0], [99, 0, 0]])
    assert inside.tolist() == [True, True, False, False]
    signed = espalier.trimesh.signed_distance(holed, [[-3, 0, 0], [0, 0, 0]])
    assert signed[0] > 0.5 and signed[1] < -0.5


def test_a_changed_mesh_is_baked_again(thing):
    rays = espalier.trimesh.RayMeshIntersector(thing)
    assert rays.intersects_any([[3, 0.1, 5]], [[0, 0, -1]]).all()
    thing.vertices += [0, 0, 100]
    assert not rays.intersects_any([[3, 0.1, 5]], [[0, 0, -1]]).any()
    once = types.SimpleNamespace(vertices=thing.vertices, faces=thing.faces)
    assert espalier.trimesh.RayMeshIntersector(once).intersects_any([[3, 0.1, 5]], [[0, 0, 1]]).all()


def test_collisions_with_names_and_data():
    manager, cube = espalier.trimesh.CollisionManager(), box()
    at = lambda x: np.array([[1, 0, 0, x], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])
    manager.add_object("near", cube)
    manager.add_object("far", cube, at(5))
    assert manager.in_collision_single(cube) is True and manager.in_collision_internal() is False
    hit, names, data = manager.in_collision_single(cube, at(5.5), return_names=True, return_data=True)
    assert hit and names == {"far"} and len(data) > 0
    for contact in data:
        assert contact.names == {"far", "__external"} and 0 <= contact.index("far") < 12
        assert 5 <= contact.point[0] <= 5.5 and contact.depth >= 0 and abs(np.linalg.norm(contact.normal) - 1) < 1e-5
    distance, name, data = manager.min_distance_single(cube, at(2), return_name=True, return_data=True)
    assert abs(distance - 1) < 1e-6 and name == "near"
    assert abs(np.linalg.norm(data.point("near") - data.point("__external")) - 1) < 1e-6 and data.distance == distance
    distance, names = manager.min_distance_internal(return_names=True)
    assert abs(distance - 4) < 1e-5 and names == ("far", "near")
    manager.set_transform("far", at(0.5))
    assert manager.in_collision_internal(return_names=True) == (True, {("far", "near")})
    assert manager.min_distance_internal(name="near") == 0
    other = espalier.trimesh.CollisionManager()
    other.add_object("third", cube, at(-3))
    assert manager.in_collision_other(other) is False and abs(manager.min_distance_other(other) - 2) < 1e-6
    other.set_transform("third", at(-0.75))
    assert manager.in_collision_other(other, return_names=True) == (True, {("near", "third")})
    manager.remove_object("near")
    raises(ValueError, "near not in", manager.remove_object, "near")
    raises(ValueError, r"\(4,4\)", manager.add_object, "x", cube, np.eye(3))


def test_convex_meshes_are_solid():
    inner, outer = box([-0.1] * 3, [0.1] * 3), box()
    manager = espalier.trimesh.CollisionManager()
    manager.add_object("surface", outer)
    assert not manager.in_collision_single(inner)
    outer.is_convex = True
    manager.add_object("solid", outer)
    assert manager.in_collision_single(inner, return_names=True) == (True, {"solid"})
    assert manager.min_distance_single(inner) == 0


def test_installing_needs_trimesh_and_can_be_undone(monkeypatch):
    import sys

    own = types.ModuleType("trimesh.proximity")
    own.closest_point = own.signed_distance = own.ProximityQuery = "own"
    for name, module in {"trimesh": types.ModuleType("trimesh"), "trimesh.proximity": own}.items():
        monkeypatch.setitem(sys.modules, name, module)
    for name in ("trimesh.ray.ray_triangle", "trimesh.ray.ray_pyembree", "trimesh.collision"):
        monkeypatch.setitem(sys.modules, name, None)
    espalier.trimesh.install()
    espalier.trimesh.install()
    assert own.closest_point is espalier.trimesh.closest_point
    espalier.trimesh.uninstall()
    assert own.closest_point == own.ProximityQuery == "own"
