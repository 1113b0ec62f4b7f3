// Scenes whose instances come, move and go, and which pairs of them touch.
import { integer, integerColumn, places as placesOf, visits } from '../arguments.js';
import { Blob } from '../blob.js';
import { OpenError, QueryError } from '../errors.js';
import { flagsOf, refuseFilter } from '../filters.js';
import { Held, Memory, releaseAll } from '../memory/held.js';
import { fieldsOfPlaces } from '../places.js';
import { YesNo } from '../results.js';
import { originOf } from '../source.js';
import { fieldsOfHandles, fieldsOfInstances } from './instances.js';
import { collectPairs } from './pairs.js';
import { withSceneQueries } from './queries.js';
import { Scene } from './scene.js';

const OK = 0, NOT_A_SCENE = 17, LARGEST_CAPACITY = 2 ** 24;

/// The block of a scene, and copies of the views of its blobs and tiles with their memory: all views of the scene share it.
class Block {
    #holders = 1;
    #memories;
    /// How often it was changed. The view for queries that a scene has made before is of no use.
    changes = 0;

    constructor(memories, blobs, blobCount) {
        this.#memories = memories;
        this.blobs = blobs;
        this.blobCount = blobCount;
    }

    hold() {
        ++this.#holders;
        return this;
    }

    letGo() {
        if (--this.#holders === 0) this.#memories.forEach((memory) => memory.letGo());
    }

    /// Holds the memory of a blob in place of that of another one. The memories begin with those of the blobs.
    replace(mesh, memory) {
        this.#memories[mesh].letGo();
        this.#memories[mesh] = memory;
    }
}

export class MovingScene extends withSceneQueries(Held, { sorts: true }) {
    #block;
    #scene;
    #origin;
    #changes;

    /// Takes over a hold of the block. write(scene) writes an espalier_moving_scene of it, and returns whether it is open.
    constructor(instance, block, write) {
        const { records, functions } = instance;
        // The view for queries, and the scene.
        const view = instance.allocate(records.scene.bytes + records.moving_scene.bytes), scene = view + records.scene.bytes;
        const own = new Memory(instance, [view]);
        if (!write(scene)) {
            own.letGo();
            throw new OpenError('the bytes are no snapshot of a moving scene with these blobs and tiles', NOT_A_SCENE);
        }
        functions.espalier_moving_scene_view(scene, view);
        super(instance, view, [own, block]);
        this.#block = block;
        this.#scene = scene;
        this.#origin = originOf(instance, scene, 'espalier_moving_scene_origin');
        this.#changes = block.changes;
    }

    /// Makes a scene in a block of `size` bytes. open(block, size, blobs, blobCount, tiles, tileCount, scene) returns
    /// whether it is one.
    static #make(instance, size, { blobs, tiles = [] }, open) {
        const { records } = instance;
        const parts = {
            tiles: viewsOf(instance, tiles, Scene, 'tiles must be an array of scenes that were baked or opened'),
            blobs: viewsOf(instance, blobs, Blob, 'blobs must be an array of blobs; scenes are given as tiles'),
        };
        const addresses = [instance.allocate(size)];
        let block = null;
        try {
            // Copies of the views of the tiles and the blobs.
            const [memory] = addresses, tilesAt = instance.allocate(records.scene.bytes * tiles.length + records.blob.bytes * blobs.length);
            addresses.push(tilesAt);
            const blobsAt = tilesAt + records.scene.bytes * tiles.length;
            copyEach(instance, parts.tiles, tilesAt, records.scene.bytes);
            copyEach(instance, parts.blobs, blobsAt, records.blob.bytes);
            const memories = [...blobs, ...tiles].map((part) => part.shared());
            block = new Block([...memories, new Memory(instance, addresses)], blobsAt, blobs.length);
            return new MovingScene(instance, block, (scene) => open(memory, size, blobsAt, blobs.length, tilesAt, tiles.length, scene));
        } catch (error) {
            if (block !== null) block.letGo();
            else releaseAll(instance, addresses);
            throw error;
        }
    }

    static create(instance, blobs, capacity, { stepExponent = -10, tiles } = {}) {
        const { functions } = instance;
        integer(capacity, 'capacity', 1, LARGEST_CAPACITY);
        integer(stepExponent, 'stepExponent', -100, 80);
        return MovingScene.#make(instance, Number(functions.espalier_moving_scene_bytes(capacity)), { blobs, tiles },
                                 (block, size, ...parts) => functions.espalier_create_moving_scene(block, size, capacity, stepExponent, ...parts));
    }

    static open(instance, snapshot, blobs, { tiles } = {}) {
        return MovingScene.#make(instance, snapshot.length, { blobs, tiles }, (block, size, ...parts) => {
            instance.array(Uint8Array, block, size).set(snapshot);
            return instance.functions.espalier_open_moving_scene(block, size, ...parts);
        });
    }

    get origin() {
        return this.use(() => Float64Array.from(this.#origin ?? [0, 0, 0]));
    }
    get sourceOrigin() {
        return this.#origin;
    }

    seenFrom(place) {
        if (place?.length !== 3) throw new TypeError('place must be an array of three numbers');
        return super.use((instance) => {
            const at = instance.allocate(instance.records.vec3d.bytes), block = this.#block.hold();
            try {
                instance.array(Float64Array, at, 3).set(place);
                return new MovingScene(instance, block, (scene) => instance.functions.espalier_moving_scene_seen_from(this.#scene, at, scene));
            } catch (error) {
                block.letGo();
                if (!(error instanceof OpenError)) throw error;
                throw new RangeError('place must be finite and less than 2^30 - 64 steps from 0 on each axis');
            } finally {
                instance.release(at);
            }
        });
    }

    /// Renews the view for queries first, if this scene or another view of its block has changed that.
    use(run) {
        return super.use((instance, view) => {
            if (this.#changes !== this.#block.changes) {
                instance.functions.espalier_moving_scene_view(this.#scene, view);
                this.#changes = this.#block.changes;
            }
            return run(instance, view);
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
        if (!Number.isInteger(mesh) || mesh < 0 || mesh >= this.#block.blobCount) throw new RangeError(`the scene has no mesh ${String(mesh)}`);
        if (blob.triangleCount === 0) throw new RangeError('the blob has no triangles');
        this.#change([], ({ instance, functions }, scene) => {
            const place = this.#block.blobs + mesh * instance.records.blob.bytes;
            const status = functions.wasm_moving_scene_set_mesh(scene, mesh, place, blob.viewIn(instance));
            if (status !== OK) throw new QueryError(`mesh ${mesh} keeps its blob: ${instance.describeQuery(status)}`, status);
            this.#block.replace(mesh, blob.shared());
        });
    }

    boxes(handles) {
        const named = fieldsOfHandles(handles);
        return this.batch(Object.values(named), (batch) => {
            const boxes = batch.allocateRecords('box_result');
            batch.functions.wasm_moving_scene_boxes(boxes, this.#scene, batch.placeRecords('instance_handle', named), batch.count);
            return batch.columns('box_result', boxes);
        });
    }

    isOnCommonLattice(handles) {
        const named = fieldsOfHandles(handles);
        return this.batch(Object.values(named), (batch) => {
            const answers = batch.allocate(batch.count);
            batch.functions.wasm_moving_scene_on_common_lattice(answers, this.#scene,
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
            batch.functions.wasm_moving_scene_block(at, this.#scene);
            const { bytes, byteCount } = batch.instance.read('bytes', at);
            return batch.copy(Uint8Array, bytes, byteCount);
        });
    }

    #fact(name) {
        return this.use(({ functions }) => functions[`espalier_moving_scene_${name}`](this.#scene));
    }

    #ofSlots(record, name) {
        const count = this.slotEnd;
        return this.batch([], (batch) => {
            const records = batch.allocateRecords(record, count);
            batch.functions[name](records, this.#scene);
            return batch.columns(record, records, count);
        });
    }

    /// Calls run(batch, scene), which may change the scene.
    #change(argumentsOfAll, run) {
        return this.batch(argumentsOfAll, (batch) => {
            ++this.#block.changes;
            return run(batch, this.#scene);
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

    /// Returns the view that counts from an origin; null where this one does, or none can.
    #viewBeside(origin) {
        const isThere = (scene) => origin.every((x, k) => x === scene.origin[k]);
        const isInWorld = origin.every((x) => Math.abs(x) < 2 ** (this.stepExponent + 30) - 2 ** (this.stepExponent + 6));
        if (origin.every((x) => x === 0) || isThere(this) || !isInWorld) return null;
        const view = this.seenFrom(origin);
        if (isThere(view)) return view;
        view.free();
        return null;
    }

    #pairs(name, { baked = null, ...options } = {}, limits) {
        refuseFilter(options, 'pairs of instances');
        if (baked !== null && !(baked instanceof Scene)) throw new TypeError('baked must be a scene that was baked or opened');
        const view = baked === null ? null : this.#viewBeside(baked.origin);
        if (view !== null) {
            try {
                return view.#pairs(name, { baked, ...options }, limits);
            } finally {
                view.free();
            }
        }
        return this.batch([], (batch) => {
            const scene = this.#scene;
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
