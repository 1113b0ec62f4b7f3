// A mesh and questions about it, the same on every machine: numbers come from integers by operations that round alike
// everywhere. For Node and browsers.

/// Returns a function of numbers in [0, 1).
export function randomNumbers(seed) {
    let state = seed;
    return () => {
        state = (state + 0x6D2B79F5) | 0;
        let z = Math.imul(state ^ (state >>> 15), state | 1);
        z ^= z + Math.imul(z ^ (z >>> 7), z | 61);
        return ((z ^ (z >>> 14)) >>> 0) / 4294967296;
    };
}

/// Returns a lumpy closed body around the origin, of radius 2 or so: the surface of a cube of cells, blown up.
export function lumpyBody(cells = 12) {
    const places = new Map(), positions = [], triangles = [];
    const random = randomNumbers(7);
    const corner = (grid) => {
        const key = grid.join();
        if (!places.has(key)) {
            places.set(key, positions.length / 3);
            const offset = grid.map((x) => 2 * x - cells);
            const reach = (2 + 0.25 * random()) / Math.sqrt(offset.reduce((sum, x) => sum + x * x, 0));
            positions.push(...offset.map((x) => x * reach));
        }
        return places.get(key);
    };
    for (let axis = 0; axis < 3; ++axis)
        for (const side of [0, cells])
            for (let row = 0; row < cells; ++row)
                for (let column = 0; column < cells; ++column) {
                    const at = (i, j) => {
                        const grid = [0, 0, 0];
                        grid[axis] = side;
                        grid[(axis + 1) % 3] = side > 0 ? column + i : row + j;
                        grid[(axis + 2) % 3] = side > 0 ? row + j : column + i;
                        return corner(grid);
                    };
                    const [a, b, c, d] = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
                    triangles.push(a, b, c, a, c, d);
                }
    return { positions: Float32Array.from(positions), triangles: Uint32Array.from(triangles) };
}

/// Returns questions, most near the body, some far away, infinite, NaN or zero.
export function questions(count = 400) {
    const random = randomNumbers(12345);
    const fill = (length, number) => Float32Array.from({ length }, number);
    const origins = fill(3 * count, () => 6 * random() - 3);
    const directions = fill(3 * count, () => 4 * random() - 2);
    const limits = fill(count, () => 0.1 + 3 * random()), radii = fill(count, () => 0.5 * random());
    for (let i = 0; i < count; i += 97) origins.set([1e20, -3e19, 2e20].map((x) => x * random()), 3 * i);
    origins.set([NaN, 0, 0, Infinity, 1, 1, 3e38, -3e38, 0, 0, 0, 0], 15);
    directions.set([0, 0, 0, 1, NaN, 0, 0, 0, -1, 1, 0, 0], 30);
    limits.set([NaN, -1, Infinity, 0], 20);
    radii.set([NaN, -1, Infinity, 0], 25);
    return { origins, directions, limits, radii, ...parts(origins, random) };
}

/// Returns the vertices of a hull near each origin, and the planes of a volume around it: 0 to 7 each, and in one hull and
/// one volume more than the library takes.
function parts(origins, random) {
    const vertices = [], planes = [], vertexOffsets = [0], planeOffsets = [0];
    for (let i = 0; i < origins.length / 3; ++i) {
        const [x, y, z] = origins.subarray(3 * i, 3 * i + 3);
        for (let k = 0; k < (i === 20 ? 65 : i % 8); ++k) vertices.push(x + random() - 0.5, y + random() - 0.5, z + random() - 0.5);
        for (let k = 0; k < (i === 21 ? 33 : i % 7); ++k) {
            const normal = [random() - 0.5, random() - 0.5, random() - 0.5];
            planes.push(...normal, normal[0] * x + normal[1] * y + normal[2] * z + 0.25 * random());
        }
        vertexOffsets.push(vertices.length / 3);
        planeOffsets.push(planes.length / 4);
    }
    return {
        vertices: Float32Array.from(vertices), vertexOffsets: Uint32Array.from(vertexOffsets),
        planes: Float32Array.from(planes), planeOffsets: Uint32Array.from(planeOffsets),
    };
}
