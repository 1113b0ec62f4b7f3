// Baked scenes: many instances of blobs, each with a place in the world, in one file.
import { flagsOf } from '../filters.js';
import { Opened } from '../memory/opened.js';
import { YesNo } from '../results.js';
import { inSource, originOf } from '../source.js';
import { withSceneQueries } from './queries.js';

export class Scene extends withSceneQueries(Opened, { sorts: false }) {
    #origin;

    /// The report of the bake; null for a scene that was opened.
    constructor(instance, bytes, report = null) {
        const { functions, records } = instance;
        const parts = (address, length) => ({
            meshes: functions.espalier_scene_mesh_count(address, length) >>> 0,
            tiles: functions.espalier_scene_tile_count(address, length) >>> 0,
        });
        // The scene, its tiles, its meshes.
        super(instance, bytes, (address, length) => {
            const { meshes, tiles } = parts(address, length);
            return records.scene.bytes * (1 + tiles) + records.blob.bytes * meshes;
        }, (view, address, length) => {
            const { meshes, tiles } = parts(address, length), tilesAt = view + records.scene.bytes;
            return functions.espalier_open_scene(address, length, tilesAt + records.scene.bytes * tiles, meshes, tilesAt, tiles, view);
        });
        this.#origin = this.use((_, view) => originOf(instance, view, 'espalier_scene_source_origin'));
        this.report = report;
    }

    get sourceOrigin() {
        return this.#origin;
    }
    /// What the bake subtracted from all places: three numbers.
    get origin() {
        return Float64Array.from(this.#origin ?? [0, 0, 0]);
    }

    get instanceCount() {
        return this.use(({ functions }, scene) => functions.espalier_scene_instance_count(scene) >>> 0);
    }
    get meshCount() {
        return this.use(({ functions }, scene) => functions.wasm_scene_mesh_count(scene) >>> 0);
    }
    /// The largest distance between the surface of any instance and its source.
    get maxError() {
        return this.use(({ functions }, scene) => functions.espalier_scene_max_error(scene));
    }
    /// The lower and the upper corner of a box around all instances, in one array.
    get bounds() {
        const { min, max } = this.structure('box', 'espalier_scene_bounds');
        return inSource([...min, ...max], this.#origin);
    }

    /// Returns all instances, each field in an array.
    instances() {
        const count = this.instanceCount;
        return this.batch([], (batch) => {
            const instances = batch.allocateRecords('instance', count);
            batch.functions.wasm_scene_instances(instances, batch.view);
            return batch.columns('instance', instances, count);
        });
    }

    /// Returns for each instance whether rays are rounded once for it and others.
    isOnCommonLattice() {
        const count = this.instanceCount;
        return this.batch([], (batch) => {
            const answers = batch.allocate(count);
            batch.functions.wasm_scene_on_common_lattice(answers, batch.view);
            return new YesNo(batch.copy(Uint8Array, answers, count));
        });
    }

    /// Returns the flags of instances.
    flags(only) {
        return flagsOf(only, this.instanceCount, 'instances');
    }
}
