// Scenes whose instances come, move and go, and which pairs of them touch.
import { integer, integerColumn, visits } from '../arguments.js';
import { Blob } from '../blob.js';
import { OpenError, QueryError } from '../errors.js';
import { flagsOf, refuseFilter } from '../filters.js';
import { Held, Memory, releaseAll } from '../memory/held.js';
import { fieldsOfPlaces } from '../places.js';
import { YesNo } from '../results.js';
import { fieldsOfHandles, fieldsOfInstances } from './instances.js';
import { collectPairs } from './pairs.js';
import { withSceneQueries } from './queries.js';
import { Scene } from './scene.js';

const OK = 0, NOT_A_SCENE = 17, LARGEST_CAPACITY = 2 ** 24;
/// Memory of the scene itself is the first that it holds; that of its meshes follows.
const FIRST_MESH = 1;

export class MovingScene extends withSceneQueries(Held, { sorts: true }) {
    #memories;
    #addresses;
    #meshCount;

    /// Makes a scene in a block of `size` bytes. open(block, size, blobs, blobCount, tiles, tileCount, scene) returns
    /// whether it is one.
    constructor(instance, size, { blobs, tiles = [] }, open) {
        const { records, functions } = instance;
        const parts = {
            tiles: viewsOf(instance, tiles, Scene, 'tiles must be an array of scenes that were baked or opened'),
            blobs: viewsOf(instance, blobs, Blob, 'blobs must be an array of blobs; scenes are given as tiles'),
        };
        const addresses = [instance.allocate(size)];
        try {
            // The view for queries, copies of those of the tiles and the blobs, and the scene.
            const tilesAt = records.scene.bytes, blobsAt = tilesAt + records.scene.bytes * tiles.length;
            const sceneAt = blobsAt + records.blob.bytes * blobs.length;
            const [block] = addresses, view = instance.allocate(sceneAt + records.moving_scene.bytes);
            addresses.push(view);
            copyEach(instance, parts.tiles, view + tilesAt, records.scene.bytes);
            copyEach(instance, parts.blobs, view + blobsAt, records.blob.bytes);
            if (!open(block, size, view + blobsAt, blobs.length, view + tilesAt, tiles.length, view + sceneAt))
                throw new OpenError('the bytes are no snapshot of a moving scene with these blobs and tiles', NOT_A_SCENE);
            functions.espalier_moving_scene_view(view + sceneAt, view);
            const memories = [new Memory(instance, addresses), ...blobs.map((blob) => blob.shared()), ...tiles.map((tile) => tile.shared())];
            super(instance, view, memories);
            this.#memories = memories;
            this.#addresses = { scene: view + sceneAt, blobs: view + blobsAt };
            this.#meshCount = blobs.length;
        } catch (error) {
            releaseAll(instance, addresses);
            throw error;
        }
    }

    static create(instance, blobs, capacity, { stepExponent = -10, tiles } = {}) {
        const { functions } = instance;
        integer(capacity, 'capacity', 1, LARGEST_CAPACITY);
        integer(stepExponent, 'stepExponent', -100, 80);
        return new MovingScene(instance, Number(functions.espalier_moving_scene_bytes(capacity)), { blobs, tiles },
                               (block, size, ...parts) => functions.espalier_create_moving_scene(block, size, capacity, stepExponent, ...parts));
    }

    static open(instance, snapshot, blobs, { tiles } = {}) {
        return new MovingScene(instance, snapshot.length, { blobs, tiles }, (block, size, ...parts) => {
            instance.array(Uint8Array, block, size).set(snapshot);
            return instance.functions.espalier_open_moving_scene(block, size, ...parts);
        });
    }

    get instanceCount() {
        return this.#fact('instance_count') >>> 0;
    }
    get capacity() {
        return this.#fact('capacity') >>> 0;
    }
    get slotEnd() {
        return this.#fact('slot_end') >>> 0;
    }
    get stepExponent() {
        return this.#fact('step_exponent');
    }
    get quality() {
        return this.#fact('quality');
    }

    /// Returns the flags of slots.
    flags(only) {
        return flagsOf(only, this.slotEnd, 'slots');
    }

    handles() {
        return this.#ofSlots('instance_handle_result', 'wasm_moving_scene_handles');
    }

    instances() {
        return this.#ofSlots('instance', 'wasm_moving_scene_instances');
    }

    insert(instances) {
        const fields = fieldsOfInstances(instances);
        return this.#change(Object.values(fields), (batch, scene) => {
            const handles = batch.allocateRecords('instance_handle_result');
            batch.functions.wasm_moving_scene_insert(handles, scene, batch.placeRecords('instance', fields), batch.count);
            return batch.columns('instance_handle_result', handles);
        });
    }

    remove(handles) {
        return this.#changeEach('remove', handles, 'instance_handle');
    }

    move(handles, places) {
        if (places === null || typeof places !== 'object') throw new TypeError('places must be an object with rotation, translation and scale');
        return this.#changeEach('move', handles, 'movement', fieldsOfPlaces(places, 'places'));
    }

    setMasks(handles, masks) {
        return this.#changeEach('set_masks', handles, 'instance_word', { word: integerColumn(masks, 'masks') });
    }

    setUsers(handles, users) {
        return this.#changeEach('set_users', handles, 'instance_word', { word: integerColumn(users, 'users') });
    }

    setMesh(mesh, blob) {
        if (!(blob instanceof Blob)) throw new TypeError('blob must be a blob');
        if (!Number.isInteger(mesh) || mesh < 0 || mesh >= this.#meshCount) throw new RangeError(`the scene has no mesh ${String(mesh)}`);
        if (blob.triangleCount === 0) throw new RangeError('the blob has no triangles');
        this.#change([], ({ instance, functions }, scene) => {
            const place = this.#addresses.blobs + mesh * instance.records.blob.bytes;
            const status = functions.wasm_moving_scene_set_mesh(scene, mesh, place, blob.viewIn(instance));
            if (status !== OK) throw new QueryError(`mesh ${mesh} keeps its blob: ${instance.describeQuery(status)}`, status);
            const before = this.#memories[FIRST_MESH + mesh];
            this.#memories[FIRST_MESH + mesh] = blob.shared();
            before.letGo();
        });
    }

    boxes(handles) {
        const named = fieldsOfHandles(handles);
        return this.batch(Object.values(named), (batch) => {
            const boxes = batch.allocateRecords('box_result');
            batch.functions.wasm_moving_scene_boxes(boxes, this.#addresses.scene, batch.placeRecords('instance_handle', named), batch.count);
            return batch.columns('box_result', boxes);
        });
    }

    isOnCommonLattice(handles) {
        const named = fieldsOfHandles(handles);
        return this.batch(Object.values(named), (batch) => {
            const answers = batch.allocate(batch.count);
            batch.functions.wasm_moving_scene_on_common_lattice(answers, this.#addresses.scene,
                batch.placeRecords('instance_handle', named), batch.count);
            return new YesNo(batch.copy(Uint8Array, answers));
        });
    }

    repack() {
        this.#change([], ({ functions }, scene) => functions.espalier_moving_scene_repack(scene));
    }

    endStep() {
        this.#change([], ({ functions }, scene) => functions.espalier_moving_scene_end_step(scene));
    }

    candidatePairs(options) {
        return this.#pairs('espalier_collect_candidate_pairs', options, []);
    }

    collidingPairs({ workLimit = Infinity, ...options } = {}) {
        return this.#pairs('espalier_collect_colliding_pairs', options, [visits(workLimit)]);
    }

    snapshot() {
        return this.batch([], (batch) => {
            const at = batch.allocateStructure('bytes');
            batch.functions.wasm_moving_scene_block(at, this.#addresses.scene);
            const { bytes, byteCount } = batch.instance.read('bytes', at);
            return batch.copy(Uint8Array, bytes, byteCount);
        });
    }

    #fact(name) {
        return this.use(({ functions }) => functions[`espalier_moving_scene_${name}`](this.#addresses.scene));
    }

    #ofSlots(record, name) {
        const count = this.slotEnd;
        return this.batch([], (batch) => {
            const records = batch.allocateRecords(record, count);
            batch.functions[name](records, this.#addresses.scene);
            return batch.columns(record, records, count);
        });
    }

    /// Calls run(batch, scene), which may change the scene, and renews the view.
    #change(argumentsOfAll, run) {
        return this.batch(argumentsOfAll, (batch) => {
            const { scene } = this.#addresses;
            try {
                return run(batch, scene);
            } finally {
                batch.functions.espalier_moving_scene_view(scene, batch.view);
            }
        });
    }

    /// Changes the instances that handles name, and returns the status of each.
    #changeEach(name, handles, record, others = {}) {
        const named = fieldsOfHandles(handles), fields = { ...named, ...others };
        return this.#change(Object.values(fields), (batch, scene) => {
            const { count } = named.slot;
            if (batch.count !== count) throw new RangeError(`handles has ${count} elements, but another argument has ${batch.count}`);
            const statuses = batch.allocate(count);
            batch.functions[`wasm_moving_scene_${name}`](statuses, scene, batch.placeRecords(record, fields), count);
            return batch.copy(Uint8Array, statuses);
        });
    }

    #pairs(name, { baked = null, ...options } = {}, limits) {
        refuseFilter(options, 'pairs of instances');
        if (baked !== null && !(baked instanceof Scene)) throw new TypeError('baked must be a scene that was baked or opened');
        return this.batch([], (batch) => {
            const { scene } = this.#addresses;
            const ofBaked = baked === null ? [] : [baked.viewIn(batch.instance)];
            const call = batch.functions[baked === null ? name : `${name}_with_baked`];
            return collectPairs(batch, baked === null ? 'instance_pair' : 'baked_pair', options, (filled, { pairs, capacity }, filter, from) =>
                call(filled, scene, ...ofBaked, pairs, capacity, ...limits, filter, from));
        });
    }
}

/// Returns the addresses of the views of blobs or scenes. `mistake` is the text for what are not those.
function viewsOf(instance, all, Type, mistake) {
    if (!Array.isArray(all) || !all.every((each) => each instanceof Type)) throw new TypeError(mistake);
    return all.map((each) => each.viewIn(instance));
}

/// Copies views, one behind the other.
function copyEach(instance, views, to, bytes) {
    const memory = instance.array(Uint8Array, 0);
    views.forEach((view, i) => memory.copyWithin(to + i * bytes, view, view + bytes));
}
