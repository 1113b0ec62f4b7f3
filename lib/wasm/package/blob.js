// Blobs: facts and lookups by triangle.
import { integers } from './arguments.js';
import { fieldsOf } from './memory/batch.js';
import { ShapeQueries } from './shapes.js';

export const PROFILES = ['fast', 'balanced', 'small', 'tiny'];

export class Blob extends ShapeQueries {
    /// The figures of the bake, and the source of each triangle; null for a blob that was opened.
    constructor(instance, bytes, { report = null, remap = null } = {}) {
        super(instance, bytes, () => instance.records.blob.bytes,
              (view, address, length) => instance.functions.espalier_open(address, length, view));
        this.report = report;
        this.remap = remap;
    }

    get triangleCount() {
        return this.#number('triangle_count');
    }
    get vertexCount() {
        return this.#number('vertex_count');
    }
    get isClosed() {
        return this.#number('is_closed') !== 0;
    }
    get hasOriginalIds() {
        return this.#number('has_original_ids') !== 0;
    }
    get profile() {
        return PROFILES[this.#number('profile')];
    }
    /// The largest distance between the baked surface and its float32 source.
    get maxError() {
        return this.use(({ functions }, blob) => functions.espalier_blob_max_error(blob));
    }
    /// The lower and the upper corner of a box around all triangles, in one array.
    get bounds() {
        const { min, max } = this.structure('box', 'espalier_blob_bounds');
        return Float32Array.of(...min, ...max);
    }

    /// Returns all facts.
    info() {
        const { origin, stepExponent } = this.structure('lattice', 'espalier_blob_lattice');
        return {
            triangleCount: this.triangleCount, vertexCount: this.vertexCount,
            duplicateReferenceCount: this.#number('duplicate_reference_count'), size: this.#number('size'),
            checksum: this.#number('checksum'), depth: this.#number('depth'), profile: this.profile,
            isClosed: this.isClosed, hasOriginalIds: this.hasOriginalIds,
            hasMaterials: this.#number('has_materials') !== 0, hasEdgeFlags: this.#number('has_edge_flags') !== 0,
            maxError: this.maxError, bounds: this.bounds, latticeOrigin: Float32Array.from(origin),
            latticeStepExponent: stepExponent,
        };
    }

    corners(triangles) {
        return this.#ofTriangles(triangles, (batch, numbers) => {
            const corners = batch.allocateRecords('triangle_result');
            batch.fill('espalier_triangle_at_arrays', numbers, corners, batch.count);
            const { value, status } = batch.columns('triangle_result', corners);
            return { corners: value, status };
        });
    }

    materials(triangles) {
        return this.#ofTriangles(triangles, (batch, numbers) => {
            const materials = batch.allocate(2 * batch.count);
            batch.fill('espalier_material_arrays', numbers, materials, batch.count);
            return batch.copy(Uint16Array, materials);
        });
    }

    originalTriangles(triangles) {
        return this.#ofTriangles(triangles, (batch, numbers) => {
            const originals = batch.allocateRecords('original_triangle_result');
            batch.fill('espalier_original_triangle_of_arrays', numbers, originals, batch.count);
            return batch.columns('original_triangle_result', originals);
        });
    }

    originalHits(hits) {
        const fields = fieldsOf(hits, { t: 1, u: 1, v: 1, normal: 3, triangle: 1, status: 1, side: 1 }, 'hits');
        return this.batch(Object.values(fields), (batch) => {
            const originals = batch.allocateRecords('original_hit');
            batch.fill('espalier_original_hit_of_batch', batch.placeRecords('ray_hit', fields), originals, batch.count);
            return batch.columns('original_hit', originals);
        });
    }

    #ofTriangles(triangles, use) {
        const array = integers(triangles, 'triangles');
        const given = { name: 'triangles', array, count: array.length, stride: 1 };
        return this.batch([given], (batch) => use(batch, batch.placeStrided(given, Uint32Array)));
    }

    #number(fact) {
        return this.use(({ functions }, blob) => functions[`espalier_blob_${fact}`](blob) >>> 0);
    }
}
