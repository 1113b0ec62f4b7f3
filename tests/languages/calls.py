"""What the calls of C++ are named in Python and in JavaScript, and why some are not there."""

SHAPES = {"Segment", "Sphere", "Capsule", "Box", "OrientedBox", "Triangle", "Cone", "ConvexVolume", "ConvexHull"}

# Which class or module has the calls whose first parameter is this.
OWNERS = {"Blob": "Blob", "PlacedBlob": "pairs", "BakedScene": "Scene", "MovingScene": "MovingScene", "Deformable": "Blob",
          "PairTouch": "pairs", "OriginalTriangle": "Blob"}

# Names in Python that are not those of C++: there, a call takes a whole batch. JavaScript has them in camel case.
NAMES = {
    "for_each_hit": "all_hits", "collect_hits": "all_hits",
    "for_each_crossing": "crossings", "collect_crossings": "crossings",
    "for_each_overlap": "overlapping_triangles", "collect_overlaps": "overlapping_triangles",
    "find_contacts": "contacts", "for_each_contact": "contacts", "collect_contacts": "contacts",
    "collect_planes": "planes",
    "pair_touch": "touches", "for_each_touch": "touches", "collect_touches": "touches", "PairTouch::contact": "touch_contacts",
    "for_each_candidate": "candidates", "original_triangle": "original_triangles", "original_hit": "original_hits",
    "material": "materials", "triangle_at": "corners", "for_each_triangle": "triangles",
    "open": "open_blob", "fix_internal_edge_normal": "fix_internal_edge_normals",
    "source_origin": "origin", "lattice": "info", "checksum": "info", "depth": "info", "has_materials": "info", "has_edge_flags": "info",
    "duplicate_reference_count": "info", "BakedScene::size": "data", "Blob::size": "info", "BakedScene::meshes": "mesh",
    "instance_at": "instances", "handle_of": "handles", "box_of": "boxes", "mesh_at": "instances",
    "set_mask": "set_masks", "set_user": "set_users", "move_instances_of": "set_mesh", "MovingScene::bytes": "snapshot",
    "MovingScene::meshes": "blobs", "refit(MovingScene)": "move",
    "create_moving_scene": "MovingScene", "collect_candidate_pairs": "candidate_pairs",
    "collect_colliding_pairs": "colliding_pairs", "is_on_common_lattice": "is_on_common_lattice",
    "create_deformable": "refit", "seal": "refit", "deformable_bytes": "refit", "Deformable::position_count": "refit",
    "describe(QueryStatus)": "Status.describe", "is_refused": "Status",
    "yes": "YesNo.yes", "no": "YesNo.no", "value_or": "YesNo.value_or", "YesNo::status": "YesNo.status",
    "describe(OpenStatus)": "OpenError", "remap_file": "Blob.remap_file",
    "mesh_count_of_scene": "open_scene", "tile_count_of_scene": "open_scene",
}
# Those in JavaScript that are not the names in Python in camel case.
NAMES_IN_JAVASCRIPT = {"MovingScene": "createMovingScene", "data": "bytes"}

# What a parameter of C++ is named as an argument: the call has to have it.
ARGUMENTS = {"TriangleFilter": "only", "SceneFilter": "mask", "Accuracy": "accuracy", "WorkLimit": "work_limit"}

P, J, C = "Python", "JavaScript", "C"
WHOLE_NUMBERS = "for cores without a floating-point unit, which run none of these languages"
ONE_LATTICE = "a scene of blobs on one lattice rounds each ray once"
HELD_BY_ESPALIER = "Espalier.describe() of the loaded module"
PLACES = "a place is a quaternion, a translation and a scale, which libraries of vectors apply"
SOURCES = "a blob with original ids has them, and a bake returns the table"
PARTS = "the program keeps the blobs that it gave"
IN_FILES = "a bake of C returns the table, and espalier_read_remap() reads files of the command"
COUNTERS = "counts the work of one query, for who tunes the library in C++ or C"
IN_ONE = "part of one call here, which holds the memory itself"
FIELDS = "fields of a shape are arrays: move points, and scale lengths, by arithmetic"
COLUMNS = "corners, materials and edge kinds are calls of their own for arrays of triangles"
STRUCTURE = "a structure or an array, whose fields are read"

# Why a language has no counterpart: patterns of the calls of C++, as the test lists them.
REASONS = [
    ((P, J), WHOLE_NUMBERS, r".*Lattice(Box|Segment|Point).*|to_lattice\(.*"),
    ((P, J), ONE_LATTICE, r".*RoundedRay.*|round_ray\(.*|lattice_of\(.*|(Baked|Moving)Scene::common_lattice\(\)"),
    # With an accuracy, the counters are an argument that can be left out.
    ((P, J), COUNTERS, r"(?!.*Accuracy).*(QueryCounters|PairCounters|SceneCounters).*"),
    ((J,), HELD_BY_ESPALIER, r"describe\(QueryStatus\)"),
    ((J,), PLACES, r"(direction_|normal_)?to_(local|world)\(Transform, Vec3\)|transform_from_matrix\(float\)"),
    ((J,), SOURCES, r"original_hit\(span<OriginalTriangle>, RayHit\)|read_remap\(.*|remap_file\(.*"),
    ((J,), PARTS, r"(BakedScene|MovingScene)::meshes\(\)"),
    ((C,), IN_FILES, r"remap_file\(BakeResult\)"),
    ((P, J), FIELDS, r"translated\(.*|to_local\(Transform, (?!Vec3).*"),
    ((P, J), STRUCTURE, r"Strided::.*|(Ray|Sphere|Box)Arrays::.*|Filled(Pairs)?::in\(auto\)|SceneFilter::.*|PlacedBlob::(blob|transform)\(\)"
                        r"|WorkLimit::.*|YesNo::of\(bool\)|Ray::between\(Vec3, Vec3\)"),
    ((P, J), COLUMNS, r"triangle_data\(.*"),
    ((P, J), IN_ONE, r"open_unchecked\(.*|(least_)?moving_scene_bytes\(uint32_t\)|MovingScene::must_refit\(\)|refit\(MovingScene\)"
                     r"|(BakedScene|MovingScene)::tiles\(\)|(Blob|Deformable|BakedScene)::status\(\)|Deformable::(blob|create|range)\(.*"),
    ((P, J), "a callback for each node would take longer than the query; the command prints the tree", r"for_each_node\(.*"),
]
