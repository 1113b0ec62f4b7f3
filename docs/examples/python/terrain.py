"""Bakes a hilly terrain with a knot above it, casts a million rays, and plots what they find.

    terrain.py PICTURE.png
"""

# %% A mesh: arrays of positions and of triangles.
import sys
import time

import numpy as np

import espalier


def grid_triangles(rows: int, columns: int, closed: bool) -> np.ndarray:
    """Returns the triangles of a grid of vertices; a closed one wraps around in both directions."""
    i, j = np.meshgrid(np.arange(rows if closed else rows - 1), np.arange(columns if closed else columns - 1), indexing="ij")
    at = lambda row, column: (row % rows) * columns + column % columns
    a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
    return np.stack([a, b, c, a, c, d], -1).reshape(-1, 3)


def terrain(size: int = 300) -> tuple[np.ndarray, np.ndarray]:
    x, y = np.meshgrid(np.linspace(-6, 6, size), np.linspace(-6, 6, size), indexing="ij")
    z = 0.5 * np.sin(1.3 * x) * np.cos(1.1 * y) + 0.15 * np.sin(4 * x + y) - 2.2
    return np.stack([x, y, z], -1).reshape(-1, 3), grid_triangles(size, size, False)


def knot(rings: int = 400, sides: int = 40) -> tuple[np.ndarray, np.ndarray]:
    def center(t: np.ndarray) -> np.ndarray:
        radius = 2 + np.cos(3 * t)
        return np.stack([radius * np.cos(2 * t), radius * np.sin(2 * t), np.sin(3 * t)], -1)

    t = np.linspace(0, 2 * np.pi, rings, endpoint=False)
    tangent = center(t + 1e-4) - center(t - 1e-4)
    tangent /= np.linalg.norm(tangent, axis=-1, keepdims=True)
    side = np.cross(tangent, [0.0, 0.0, 1.0])
    side /= np.linalg.norm(side, axis=-1, keepdims=True)
    up = np.cross(side, tangent)
    turn = np.linspace(0, 2 * np.pi, sides, endpoint=False)[None, :, None]
    positions = center(t)[:, None] + 0.45 * (np.cos(turn) * side[:, None] + np.sin(turn) * up[:, None])
    return positions.reshape(-1, 3), grid_triangles(rings, sides, True)


# %% Bake: 0.5 mm between source and baked surface, if the unit is a meter.
blob = espalier.bake_meshes([terrain(), knot()], tolerance=0.0005, original_ids=True)
print(blob, f"{len(blob.data) / blob.triangle_count:.1f} bytes per triangle")

# %% Cast: a camera of 1,000 x 1,000 rays.
eye, target = np.array([7.0, -7.5, 6.0]), np.array([0.0, 0.0, -0.9])
forward = (target - eye) / np.linalg.norm(target - eye)
right = np.cross(forward, [0, 0, 1])
right /= np.linalg.norm(right)
up = np.cross(right, forward)
across, down = np.meshgrid(np.linspace(-0.42, 0.42, 1000), np.linspace(0.42, -0.42, 1000))
directions = forward + across[..., None] * right + down[..., None] * up

start = time.perf_counter()
view = blob.raycast_sources(eye, directions, threads=0)
print(f"{directions.size // 3:,} rays in {time.perf_counter() - start:.2f} s")
hit = view.hits["status"] == espalier.Status.OK

# %% Shadows and distance: rays from the places that were hit to the light, and the height of the knot above the ground.
light = np.array([-4.0, -3.0, 9.0])
normal = view.hits["normal"] * np.where(view.hits["side"] == espalier.Side.BACK, -1, 1)[..., None]
places = np.where(hit[..., None], view.points, 0)
# A ray to the light must not hit the ground that it starts from: both rays are rounded, by up to these lengths.
rounded = (blob.rounding_error(espalier.Ray(eye, directions))["value"]
           + blob.rounding_error(espalier.Ray(places, light - places))["value"])
lifted = places + 2 * rounded[..., None] * normal
shadow = blob.occluded(lifted, light - lifted, t_max=1.0, threads=0).value_or(False)
slope = np.clip(np.einsum("ijk,ijk->ij", normal, (light - lifted) / np.linalg.norm(light - lifted, axis=-1, keepdims=True)), 0, 1)
brightness = 0.25 + 0.75 * slope * ~shadow

# %% Plot.
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

colors = np.where((view.sources["mesh"] == 1)[..., None], [0.90, 0.55, 0.20], [0.45, 0.62, 0.40]) * brightness[..., None]
colors[~hit] = [0.80, 0.87, 0.95]

x = np.linspace(-6, 6, 400, dtype=np.float32)
slice_points = np.stack(np.meshgrid(x, [0.0], x * 0.5 - 0.5, indexing="ij"), -1)[:, 0]
distance = blob.closest_point(slice_points, threads=0)["distance"]

figure, (picture, cut) = plt.subplots(1, 2, figsize=(13, 6), width_ratios=[1.1, 1])
picture.imshow(np.clip(colors, 0, 1))
picture.set_title("a million rays, colored by their source, with shadows")
picture.axis("off")
levels = cut.contourf(x, x * 0.5 - 0.5, distance.T, 24, cmap="viridis")
cut.contour(x, x * 0.5 - 0.5, distance.T, [0.02], colors="white", linewidths=1)
cut.set_title("distance to the surface in the plane y = 0")
cut.set_xlabel("x")
cut.set_ylabel("z")
cut.set_aspect("equal")
figure.colorbar(levels, ax=cut, shrink=0.6)
figure.tight_layout()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "terrain.png", dpi=80)
