// Blobs: facts and lookups by triangle.
import { integers, places } from './arguments.js';
import { fieldsOf } from './memory/batch.js';
import { EdgeQueries } from './edges.js';
import { QueryError } from './errors.js';
import { inSource, originOf } from './source.js';

export const PROFILES = ['fast', 'balanced', 'small', 'tiny'];

const OK = 0;

export class Blob extends EdgeQueries {
    #instance;
    #origin;

    /// The figures of the bake, and the source of each triangle; null for a blob that was opened.
    constructor(instance, bytes, { report = null, remap = null } = {}) {
        super(instance, bytes, () => instance.records.blob.bytes,
              (view, address, length) => instance.functions.espalier_open(address, length, view));
        this.#instance = instance;
        this.#origin = this.use(originOf);
        this.report = report;
        this.remap = remap;
    }

    get sourceOrigin() {
        return this.#origin;
    }
    /// What the bake subtracted from all positions: three numbers.
    get origin() {
        return Float64Array.from(this.#origin ?? [0, 0, 0]);
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
    get isDeformable() {
        return this.#number('is_deformable') !== 0;
    }
    get hasOriginalIds() {
        return this.#number('has_original_ids') !== 0;
    }
    get profile() {
        return PROFILES[this.#number('profile')];
    }
    /// The largest distance between the baked surface and its source.
    get maxError() {
        return this.use(({ functions }, blob) => functions.espalier_blob_max_error(blob));
    }
    /// The lower and the upper corner of a box around all triangles, in one array.
    get bounds() {
        const { min, max } = this.structure('box', 'espalier_blob_bounds');
        return inSource([...min, ...max], this.#origin);
    }

    /// Returns all facts.
    info() {
        const { origin, stepExponent } = this.structure('lattice', 'espalier_blob_lattice');
        return {
            triangleCount: this.triangleCount, vertexCount: this.vertexCount,
            duplicateReferenceCount: this.#number('duplicate_reference_count'), size: this.#number('size'),
            checksum: this.#number('checksum'), depth: this.#number('depth'), profile: this.profile,
            isClosed: this.isClosed, isDeformable: this.isDeformable, hasOriginalIds: this.hasOriginalIds,
            hasMaterials: this.#number('has_materials') !== 0, hasEdgeFlags: this.#number('has_edge_flags') !== 0,
            maxError: this.maxError, bounds: this.bounds, origin: this.origin, latticeOrigin: inSource(origin, this.#origin),
            latticeStepExponent: stepExponent,
        };
    }

    /// Returns the corners of all triangles in baked order.
    triangles() {
        const { triangleCount } = this;
        return this.corners(Uint32Array.from({ length: triangleCount }, (_, i) => i)).corners;
    }

    /// Returns the blob with its vertices at other positions, and the cost of its tree over that at rest.
    refit(positions) {
        const given = places(positions, 'positions');
        return this.batch([], (batch) => {
            const { functions, instance } = batch, bytes = this.bytes();
            const copy = batch.allocate(bytes.length), blob = batch.allocateStructure('blob'), mesh = batch.allocateStructure('deformable');
            instance.array(Uint8Array, copy, bytes.length).set(bytes);
            functions.espalier_open(copy, bytes.length, blob);
            batch.check(functions.espalier_create_deformable(blob, copy, functions.espalier_deformable_bytes(blob), mesh));
            const result = batch.allocateStructure('refit_result');
            functions.espalier_deformable_refit(result, mesh, batch.placeAll(given, 3), given.count);
            const { status, position, quality } = instance.read('refit_result', result);
            if (status !== OK) throw new QueryError(refusalOfRefit(functions.espalier_deformable_position_count(mesh), given.count, position, status, instance), status);
            batch.check(functions.espalier_deformable_seal(mesh, copy, bytes.length));
            return { blob: new Blob(this.#instance, batch.copy(Uint8Array, copy, bytes.length), { remap: this.remap }), quality };
        });
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

function refusalOfRefit(wanted, given, position, status, instance) {
    if (given !== wanted) return `the blob was baked from ${wanted} positions, not from ${given}`;
    return `position ${position}: ${instance.describeQuery(status)}`;
}
