// The peer: three-mesh-bvh of npm, in a folder that has node_modules with it and three.
import { readFile } from 'node:fs/promises';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

/// Imports the module of a package in a folder. Those that it imports are found from there.
async function importFrom(folder, name) {
    const root = resolve(folder, 'node_modules', name), description = JSON.parse(await readFile(`${root}/package.json`));
    const main = description.exports?.['.']?.import ?? description.module;
    const file = typeof main === 'string' ? main : main.default;
    return { version: description.version, ...await import(pathToFileURL(resolve(root, file))) };
}

export async function loadPeer(folder) {
    const three = await importFrom(folder, 'three'), bvh = await importFrom(folder, 'three-mesh-bvh');
    return {
        name: `three-mesh-bvh ${bvh.version}, three ${three.version}`,
        /// Builds a tree with the surface area heuristic, the slowest and best of its builders.
        build({ positions, triangles }) {
            const geometry = new three.BufferGeometry();
            geometry.setAttribute('position', new three.BufferAttribute(positions.slice(), 3));
            geometry.setIndex(new three.BufferAttribute(triangles.slice(), 1));
            const tree = new bvh.MeshBVH(geometry, { strategy: bvh.SAH });
            const { roots } = bvh.MeshBVH.serialize(tree);
            // A query reads the nodes, the indices and the positions.
            const bytes = roots.reduce((sum, root) => sum + root.byteLength, 0) + geometry.index.array.byteLength + positions.byteLength;
            const ray = new three.Ray(), point = new three.Vector3(), target = {};
            return {
                bytes,
                raycast({ origins, directions }, first, count) {
                    const t = new Float32Array(count);
                    for (let i = 0; i < count; ++i) {
                        ray.origin.fromArray(origins, 3 * (first + i));
                        ray.direction.fromArray(directions, 3 * (first + i));
                        t[i] = tree.raycastFirst(ray, three.DoubleSide)?.distance ?? Infinity;
                    }
                    return t;
                },
                closestPoint({ points }, first, count) {
                    const distances = new Float32Array(count);
                    for (let i = 0; i < count; ++i) {
                        point.fromArray(points, 3 * (first + i));
                        distances[i] = tree.closestPointToPoint(point, target).distance;
                    }
                    return distances;
                },
            };
        },
    };
}
