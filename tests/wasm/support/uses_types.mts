// Uses every declaration of index.d.ts and of the files that it names.
import {
    BakeError, Blob, EdgeKind, EspalierError, Feature, hasSimd, Lists, load, MemoryError, MovingScene, NO_TRIANGLE, OpenError, pairs, QueryError, Scene, Side, Status,
    VerifyError, YesNo, type BakedPairs, type BakeOptions, type BakeReport, type BlobInfo, type Box, type ClosestPoints, type CollectedPairs, type Contacts,
    type ConvexHull, type ConvexVolume, type Corners, type Espalier, type Flags, type FoundHandles, type InstancePairs, type Instances, type InstancesToBake,
    type Mesh, type OriginalHits, type PlaceArray, type RayHits, type SceneClosestPoints, type SceneRayHits, type SceneSweepHits, type SceneTriangles, type SweepHits, type Volume, type Ways, type WindingNumbers,
} from 'espalier';

const library: Espalier = await load();
await load('./espalier.wasm');
await load(new URL('https://localhost/espalier.wasm'), { simd: false });
await load(fetch('/espalier.wasm'));
await load(new Uint8Array(8));
const hasIt: boolean = hasSimd();

const mesh: Mesh = { positions: new Float64Array(9), triangles: new Uint16Array(3), materials: [1], name: 'walls', file: 0, mesh: 1 };
const options: BakeOptions = { tolerance: 0.001, profile: 'small', effort: 'best', originalIds: true, flatAngle: 5, origin: [0, 0, 1] };
const blob: Blob = await library.bake([mesh, { positions: { array: [0, 0, 0], stride: 5 }, triangles: [0, 1, 2] }], options);
const report: BakeReport | null = blob.report;
const first: string | undefined = report?.zeroArea.first;
const info: BlobInfo = blob.info();
const places: PlaceArray[] = [blob.origin, blob.bounds, (await library.bake(mesh, { origin: 'auto' })).triangles()];
const other: Blob = library.openBlob(blob.bytes());
await library.verify(other);

const origins = new Float32Array(30), directions = [0, 0, -1];
const hits: RayHits = blob.raycast(origins, directions, { tMin: 0, tMax: new Float32Array(10), culling: 'back' });
const isHit: boolean = hits.status[0] === Status.OK && hits.triangle[0] !== NO_TRIANGLE && hits.side[0] === Side.FRONT;
const answers: YesNo = blob.occluded({ array: origins, stride: 6, offset: 3 }, directions);
const yes: boolean = answers.yes(0) || answers.valueOr(1, true) || !answers.no(2);
const lists: Lists<RayHits> = blob.allHits(origins, directions);
const items: Float32Array = blob.closestHits(origins, directions, 4).items.t.subarray(lists.begin(0), lists.end(0));
blob.crossings(origins, directions);

const box: Box = { kind: 'box', min: [0, 0, 0], max: [1, 1, 1] };
const nearest: ClosestPoints = blob.closestPoint(box, 2);
blob.closestPoint({ kind: 'segment', from: origins, to: directions });
const isFace: boolean = blob.signedDistance(origins).feature[0] === Feature.FACE;
const several: Lists<ClosestPoints> = blob.closestTriangles(origins, 4, 1);
const inside: YesNo = blob.contains(origins);
const windings: WindingNumbers = blob.windingNumber(origins, 64);

const volumes: Volume[] = [
    box, { kind: 'sphere', center: origins, radius: 1 }, { kind: 'capsule', from: origins, to: origins, radius: [1] },
    { kind: 'orientedBox', center: origins, halfAxes: new Float32Array(9) },
    { kind: 'cone', apex: origins, axis: directions, radius: 1 }, { kind: 'triangle', a: origins, b: origins, c: directions },
];
for (const volume of volumes) blob.overlaps(volume);
const touched: Lists<Uint32Array> = blob.overlappingTriangles(volumes[0]);
const near: Lists<Contacts> = blob.contacts({ kind: 'sphere', center: origins, radius: 1 }, 8, [0.1]);
blob.contacts({ kind: 'orientedBox', center: origins, halfAxes: new Float32Array(9) }, 8);
const sweeps: SweepHits = blob.sweep(box, directions, { skin: 0.01, ignoreLeaving: true, culling: 'front' });

const moved: pairs.PlacedBlob = { blob: other, rotation: [0, 0, 0, 1], translation: origins, scale: 2 };
const limited: pairs.PairOptions = { workLimit: 1000 };
const touching: YesNo = pairs.overlaps(blob, moved, limited);
const within: YesNo = pairs.withinDistance(moved, blob, [1, 2]);
const contact: pairs.PairContacts = pairs.firstContact(blob, other);
const contacts: Lists<pairs.PairContacts> = pairs.contacts(blob, moved, { workLimit: Infinity });
const touches: Lists<pairs.PairTouches> = pairs.touches(blob, moved);
const apart: pairs.BlobDistances = pairs.distance({ blob }, moved, { maxDistance: 2, workLimit: 5 });

const instances: InstancesToBake = { translation: origins, rotation: [0, 0, 0, 1], scale: [1], mesh: new Uint8Array(10), mask: 1, user: [7] };
const scene: Scene = await library.bakeScene([blob, other.bytes()], instances);
const tiled: Scene = library.openScene((await library.bakeScene([scene])).bytes());
await library.verifyScene(tiled);
const baked: Instances = scene.instances();
const inScene: SceneRayHits = scene.raycast(origins, directions, { tMax: 5, mask: 1 });
const hidden: YesNo = scene.occluded(origins, directions, { culling: 'back' });
const throughAll: Lists<SceneRayHits> = scene.allHits(origins, directions);
const closest: SceneClosestPoints = scene.closestPoint(origins, 2, { mask: 3 });
const touchedAny: YesNo = scene.overlaps(volumes[0], { mask: 3 });
const touchedAll: Lists<SceneTriangles> = scene.overlappingTriangles(volumes[0]);
const sweptIn: SceneSweepHits = scene.sweep(box, directions, { skin: 0.01, mask: 3 });
const flags: Flags = new Uint8Array(blob.triangleCount), filtered: RayHits = blob.raycast(origins, directions, { only: flags, tMax: 5 });
blob.occluded(origins, directions, { only: [true, false] });
blob.closestHits(origins, directions, 4, { only: null });
const hull: ConvexHull = { kind: 'convexHull', vertices: origins, offsets: [0, 4, 10] };
const volume: ConvexVolume = { kind: 'convexVolume', planes: new Float32Array(24) };
const sweptHulls: SweepHits = blob.sweep(hull, directions, { only: flags }), hullContacts: Lists<Contacts> = blob.contacts(hull, 4);
const inVolume: YesNo = blob.overlaps(volume), trianglesIn: Lists<Uint32Array> = blob.overlappingTriangles(volume);
const hullInScene: SceneSweepHits = scene.sweep(hull, directions, { only: [true], mask: 1 });

const moving: MovingScene = library.createMovingScene([blob, other], 100, { stepExponent: -8, tiles: [scene] });
const handles: FoundHandles = moving.insert(instances), statuses: Uint8Array = moving.move(handles, { translation: origins });
moving.remove({ slot: 0, generation: handles.generation[0] });
moving.setMasks(handles, 1);
moving.setUsers(moving.handles(), new Uint32Array(10));
moving.setMesh(0, other);
moving.repack();
moving.endStep();
const candidates: CollectedPairs<InstancePairs> = moving.candidatePairs({ onlyMoved: true });
const collisions: CollectedPairs<InstancePairs> = moving.collidingPairs({ workLimit: 1000, start: candidates.next });
const collisionsWithScene: CollectedPairs<BakedPairs> = moving.collidingPairs({ baked: scene });
const wayBack: MovingScene = library.openMovingScene(moving.snapshot(), [blob, other], { tiles: [scene] });
const inMoving: SceneRayHits = wayBack.raycast(origins, directions, { only: new Uint8Array(wayBack.slotEnd) });
const slots: Instances = moving.instances();
const movingFacts: number[] = [moving.instanceCount, moving.capacity, moving.slotEnd, moving.stepExponent, moving.quality];
if (!moving.isFreed) moving.free();

const facts: number[] = [scene.instanceCount, scene.meshCount, scene.maxError, ...scene.bounds];
if (!scene.isFreed) scene.free();

const corners: Corners = blob.corners(hits.triangle);
const sources: OriginalHits = blob.originalHits(hits);
const materials: Uint16Array = blob.materials([0, 1]);
blob.originalTriangles(0);
const kept = library.reduceContacts(blob.contacts({ kind: 'sphere', center: origins, radius: 1 }, 16));
const ways: Ways = library.solvePlanes(blob.planes({ kind: 'capsule', from: origins, to: directions, radius: 1 }, 8, 0.5), [1, 0, 0], 0.01);
const ofTouches = library.reduceContacts(pairs.touchContacts(pairs.touches(blob, other)));
const bends: number[] = [...blob.edgeKinds([0, 1]).ab, ...blob.fixInternalEdgeNormals(0, Feature.EDGE_AB, origins), EdgeKind.FLAT];
const rounded: Float32Array[] = [blob.roundingError(origins), blob.roundingError({ kind: 'ray', origin: origins, direction: origins }),
    blob.roundingError({ kind: 'box', min: origins, max: origins }, origins)].map(({ value }) => value);
const coarse: boolean[] = [blob.occluded(origins, origins, { accuracy: 1 }).yes(0),
    blob.overlaps({ kind: 'sphere', center: origins, radius: 1 }, { accuracy: 1 }).yes(0), blob.distanceBounds(origins, 1).lower[0] > 0];
const bounding = [blob.boundingSphere().radius, blob.orientedBounds().center, blob.kDopBounds().low, blob.triangles(), library.describe(Status.OK)];
const { blob: pose, quality } = blob.refit(origins);
if (blob.isDeformable) console.log(pose.triangleCount, quality, kept.items.distance, ofTouches.length, bends, rounded, coarse, bounding);
const nearBox = [scene, moving].map((each) => each.candidates({ kind: 'box', min: origins, max: origins }).items.instance);
console.log(nearBox, moving.boxes(handles).min, scene.isOnCommonLattice().no(0));
blob.free();
const errors: EspalierError[] = [];
for (const type of [BakeError, OpenError, QueryError, MemoryError, VerifyError])
    for (const error of errors) if (error instanceof type) console.log(error.status);

export { collisions, collisionsWithScene, filtered, hullContacts, hullInScene, inMoving, inVolume, movingFacts, slots, statuses, sweptHulls, trianglesIn };
export { apart, baked, closest, contact, facts, hidden, inScene, sweptIn, throughAll, touchedAll, touchedAny,
    contacts, corners, first, hasIt, info, inside, isFace, isHit, items, materials, near, nearest, places, several, sources, sweeps, touched, touches, touching, windings, within, yes };
