// Claims about what espalier.h has: a function for each that the C++ headers have, and each of them is asked. Read from
// the headers themselves, so that a query that is added for C++ alone is noticed.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

using Path = std::filesystem::path;

namespace {

const Path project = ESPALIER_PROJECT_FOLDER;

/// What C++ has and what C has for it. `-` where C needs none. A line that ends in a bracket goes on in the next one.
/// After "Shape:", up to a blank line, each line stands for one of each of those shapes.
const char* const table = R"(
    describe(OpenStatus)                                              espalier_describe_open_status
    describe(QueryStatus)                                         espalier_describe_query_status

    is_refused(QueryStatus)                                       espalier_is_refused
    YesNo::yes()                                                  espalier_yes
    YesNo::no()                                                   espalier_no
    YesNo::value_or(bool)                                         -
    YesNo::of(bool)                                               -
    YesNo::status()                                               -
    Filled::in(auto)                                              -
    bool()                                                        -

    open(span<byte>)                                              espalier_open
    open_unchecked(span<byte>)                                    espalier_open_unchecked
    Blob::status()                                                espalier_blob_status
    Blob::triangle_count()                                        espalier_blob_triangle_count
    Blob::duplicate_reference_count()                             espalier_blob_duplicate_reference_count
    Blob::vertex_count()                                          espalier_blob_vertex_count
    Blob::size()                                                  espalier_blob_size
    Blob::checksum()                                              espalier_blob_checksum
    Blob::depth()                                                 espalier_blob_depth
    Blob::profile()                                               espalier_blob_profile
    Blob::lattice()                                               espalier_blob_lattice
    Blob::max_error()                                             espalier_blob_max_error
    Blob::bounds()                                                espalier_blob_bounds
    Blob::is_closed()                                             espalier_blob_is_closed
    Blob::is_deformable()                                         espalier_blob_is_deformable
    Blob::has_original_ids()                                      espalier_blob_has_original_ids
    Blob::has_materials()                                         espalier_blob_has_materials
    Blob::has_edge_flags()                                        espalier_blob_has_edge_flags
    material(Blob, TriangleId)                                    espalier_material

    edge_kinds(Blob, TriangleId)                                  espalier_edge_kinds_of
    fix_internal_edge_normal(Blob, TriangleId, Feature, Vec3)     espalier_fix_internal_edge_normal

    deformable_bytes(Blob)                                        espalier_deformable_bytes
    create_deformable(Blob, span<byte>)                           espalier_create_deformable
    Deformable::status()                                          espalier_deformable_status
    Deformable::blob()                                            espalier_deformable_blob
    Deformable::position_count()                                  espalier_deformable_position_count
    Deformable::range()                                           espalier_deformable_range
    Deformable::create(Blob, byte)                                -
    refit(Deformable, span<Vec3>)                                 espalier_deformable_refit
    seal(Deformable, span<byte>)                                  espalier_deformable_seal

    bounding_sphere(Blob)                                         espalier_bounding_sphere
    oriented_bounds(Blob)                                         espalier_oriented_bounds
    k_dop_bounds(Blob)                                            espalier_k_dop_bounds

    Ray::between(Vec3, Vec3)                                      espalier_ray_between
    raycast(Blob, Ray)                                            espalier_raycast
    raycast(Blob, Ray, TriangleFilter)                            espalier_raycast_filtered
    occluded(Blob, Ray)                                           espalier_occluded
    occluded(Blob, Ray, TriangleFilter)                           espalier_occluded_filtered
    closest_hits(Blob, Ray, span<RayHit>)                         espalier_closest_hits
    closest_hits(Blob, Ray, span<RayHit>, TriangleFilter)         espalier_closest_hits_filtered
    for_each_hit(Blob, Ray, Visitor<RayHit>)                      espalier_for_each_hit
    for_each_crossing(Blob, Ray, Visitor<RayHit>)                 espalier_for_each_crossing
    raycast(Blob, span<Ray>, span<RayHit>)                        espalier_raycast_batch
    occluded(Blob, span<Ray>, span<YesNo>)                        espalier_occluded_batch

    Strided::at(size_t)                                           -
    Strided::from(size_t)                                         -
    RayArrays::at(size_t)                                         -
    RayArrays::from(size_t)                                       -
    SphereArrays::at(size_t)                                      -
    SphereArrays::from(size_t)                                    -
    BoxArrays::at(size_t)                                         -
    BoxArrays::from(size_t)                                       -
    raycast(Blob, RayArrays, span<RayHit>)                        espalier_raycast_arrays
    occluded(Blob, RayArrays, span<YesNo>)                        espalier_occluded_arrays
    closest_hits(Blob, RayArrays, span<RayHit>, span<Filled>)     espalier_closest_hits_arrays
    collect_hits(Blob, RayArrays, span<QueryStatus>, span<size_t>, span<RayHit>) espalier_collect_hits_arrays
    collect_crossings(Blob, RayArrays, span<QueryStatus>, span<size_t>, span<RayHit>) espalier_collect_crossings_arrays
    closest_point(Blob, Strided<Vec3>, span<ClosestPoint>, float) espalier_closest_point_arrays
    signed_distance(Blob, Strided<Vec3>, span<ClosestPoint>, float) espalier_signed_distance_arrays
    contains(Blob, Strided<Vec3>, span<YesNo>)                    espalier_contains_arrays
    closest_triangles(Blob, Strided<Vec3>, span<ClosestPoint>, span<Filled>, float) espalier_closest_triangles_arrays
    overlaps(Blob, SphereArrays, span<YesNo>)                     espalier_overlaps_sphere_arrays
    overlaps(Blob, BoxArrays, span<YesNo>)                        espalier_overlaps_box_arrays
    collect_overlaps(Blob, SphereArrays, span<QueryStatus>, span<size_t>, span<TriangleId>)
        espalier_collect_overlaps_sphere_arrays
    collect_overlaps(Blob, BoxArrays, span<QueryStatus>, span<size_t>, span<TriangleId>)
        espalier_collect_overlaps_box_arrays
    original_triangle(Blob, Strided<TriangleId>, span<Result<OriginalTriangle>>) espalier_original_triangle_of_arrays
    material(Blob, Strided<TriangleId>, span<uint16_t>)           espalier_material_arrays
    triangle_at(Blob, Strided<TriangleId>, span<Result<Triangle>>) espalier_triangle_at_arrays

    original_triangle(Blob, TriangleId)                           espalier_original_triangle_of
    original_triangle(Blob, span<TriangleId>, span<Result<OriginalTriangle>>) espalier_original_triangle_of_batch
    original_hit(Blob, RayHit)                                    espalier_original_hit_of
    original_hit(Blob, span<RayHit>, span<OriginalHit>)           espalier_original_hit_of_batch
    original_hit(span<OriginalTriangle>, RayHit)                  espalier_original_hit_by_remap
    read_remap(span<byte>, Blob, span<OriginalTriangle>)          espalier_read_remap

    Shape: Sphere Capsule Box OrientedBox Cone Triangle ConvexVolume LatticeBox
    overlaps(Blob, Shape)                                         espalier_overlaps_shape
    for_each_overlap(Blob, Shape, TriangleVisitor)                espalier_for_each_overlap_shape
    collect_overlaps(Blob, Shape, span<TriangleId>, Cursor)       espalier_collect_overlaps_shape

    closest_point(Blob, Vec3, float)                              espalier_closest_point
    closest_triangles(Blob, Vec3, span<ClosestPoint>, float)      espalier_closest_triangles
    contains(Blob, Vec3)                                          espalier_contains
    winding_number(Blob, Vec3, unsigned)                          espalier_winding_number
    signed_distance(Blob, Vec3, float)                            espalier_signed_distance

    Shape: Segment Box
    closest_point(Blob, Shape, float)                             espalier_closest_point_shape

    rounding_error(Blob, Vec3)                                    espalier_rounding_error_point

    Shape: Ray Segment Sphere Capsule Box OrientedBox Triangle
    rounding_error(Blob, Shape)                                   espalier_rounding_error_shape

    Shape: Sphere Capsule Box OrientedBox ConvexHull
    rounding_error(Blob, Shape, Vec3)                             espalier_rounding_error_sweep_shape
    sweep(Blob, Shape, Vec3, TriangleFilter)                      espalier_sweep_shape
    sweep(Blob, Shape, Vec3, SweepOptions)                        espalier_sweep_shape_with_options

    Shape: Sphere Capsule OrientedBox ConvexHull
    find_contacts(Blob, Shape, float, span<Contact>)              espalier_find_contacts_shape

    reduce_contacts(span<Contact>)                                espalier_reduce_contacts

    PlacedBlob::blob()                                            -
    PlacedBlob::transform()                                       -
    to_local(Transform, Vec3)                                     espalier_to_local_point
    direction_to_local(Transform, Vec3)                           espalier_direction_to_local
    to_world(Transform, Vec3)                                     espalier_to_world_point
    direction_to_world(Transform, Vec3)                           espalier_direction_to_world
    normal_to_world(Transform, Vec3)                              espalier_normal_to_world
    translated(Vec3, Vec3)                                        espalier_translated_point
    transform_from_matrix(float (rows)[3][4])                     espalier_transform_from_matrix

    Shape: Segment Sphere Capsule Triangle Box OrientedBox Cone Plane Ray RoundedRay Transform
    to_local(Transform, Shape)                                    espalier_to_local_shape

    Shape: Segment Sphere Capsule Triangle Box OrientedBox Cone Ray
    translated(Shape, Vec3)                                       espalier_translated_shape

    WorkLimit::unlimited()                                        -
    WorkLimit::visits()                                           -
    overlaps(PlacedBlob, PlacedBlob, WorkLimit)                   espalier_overlaps_blob
    first_contact(PlacedBlob, PlacedBlob, WorkLimit)              espalier_first_contact
    for_each_contact(PlacedBlob, PlacedBlob, Visitor<PairContact>, WorkLimit) espalier_for_each_contact
    collect_contacts(PlacedBlob, PlacedBlob, span<PairContact>, WorkLimit, Cursor) espalier_collect_contacts
    pair_touch(PlacedBlob, PlacedBlob, PairContact)               espalier_pair_touch_of
    for_each_touch(PlacedBlob, PlacedBlob, Visitor<PairTouch>, WorkLimit) espalier_for_each_touch
    collect_touches(PlacedBlob, PlacedBlob, span<PairTouch>, WorkLimit, Cursor) espalier_collect_touches
    PairTouch::contact(size_t)                                    espalier_contact_of_touch
    distance(PlacedBlob, PlacedBlob, WorkLimit, float)            espalier_distance
    within_distance(PlacedBlob, PlacedBlob, float, WorkLimit)     espalier_within_distance

    raycast(Blob, Ray, QueryCounters)                             espalier_raycast_counted
    QueryCounters::count_node()                                   -
    QueryCounters::count_leaf()                                   -
    QueryCounters::count_triangles(unsigned)                      -
    QueryCounters::count_candidates(unsigned)                     -
    first_contact(PlacedBlob, PlacedBlob, WorkLimit, PairCounters) espalier_first_contact_counted
    distance(PlacedBlob, PlacedBlob, WorkLimit, float, PairCounters) espalier_distance_counted
    PairCounters::count_leaves(unsigned, unsigned)                -
    occluded(Blob, Ray, Accuracy, QueryCounters)                  espalier_occluded_approximate
    distance_bounds(Blob, Vec3, float, Accuracy, QueryCounters)   espalier_distance_bounds

    Shape: Sphere Box
    overlaps(Blob, Shape, Accuracy, QueryCounters)                espalier_overlaps_shape_approximate

    for_each_triangle(Blob, TriangleVisitor)                      espalier_for_each_triangle
    triangle_at(Blob, TriangleId)                                 espalier_triangle_at
    for_each_node(Blob, FunctionRef<NodeVisit(TreeNode)>)         espalier_for_each_node

    to_lattice(Lattice, Vec3)                                     espalier_to_lattice_point
    to_lattice(Lattice, Box)                                      espalier_to_lattice_box
    to_local(Lattice, LatticePoint)                               espalier_to_local
    lattice_of(span<Blob>)                                        espalier_lattice_of_blobs
    round_ray(Lattice, Ray)                                       espalier_round_ray
    RoundedRay::data()                                            -
    RoundedRay::status()                                          espalier_rounded_ray_status
    raycast(Blob, RoundedRay)                                     espalier_raycast_rounded
    occluded(Blob, RoundedRay)                                    espalier_occluded_rounded
    raycast(Blob, RoundedRay, TriangleFilter)                     espalier_raycast_rounded_filtered
    occluded(Blob, RoundedRay, TriangleFilter)                    espalier_occluded_rounded_filtered
    for_each_hit(Blob, RoundedRay, Visitor<RayHit>)               espalier_for_each_hit_rounded
    for_each_crossing(Blob, RoundedRay, Visitor<RayHit>)          espalier_for_each_crossing_rounded
    raycast(Blob, Segment)                                        espalier_raycast_lattice_segment
    occluded(Blob, Segment)                                       espalier_occluded_lattice_segment

    mesh_count_of_scene(span<byte>)                               espalier_scene_mesh_count
    tile_count_of_scene(span<byte>)                               espalier_scene_tile_count
    open_scene(span<byte>, span<Blob>, span<BakedScene>)          espalier_open_scene
    BakedScene::status()                                          espalier_scene_status
    BakedScene::instance_count()                                  espalier_scene_instance_count
    BakedScene::meshes()                                          espalier_scene_meshes
    BakedScene::tiles()                                           espalier_scene_tiles
    BakedScene::size()                                            espalier_scene_size
    BakedScene::max_error()                                       espalier_scene_max_error
    BakedScene::bounds()                                          espalier_scene_bounds
    BakedScene::common_lattice()                                  espalier_scene_common_lattice
    instance_at(BakedScene, InstanceId)                           espalier_scene_instance_at
    mesh_at(BakedScene, InstanceId)                               espalier_scene_mesh_at
    is_on_common_lattice(BakedScene, InstanceId)                  espalier_scene_is_on_common_lattice
    SceneFilter::mask()                                           -
    SceneFilter::keep()                                           -
    raycast(BakedScene, Ray, SceneFilter)                         espalier_scene_raycast
    raycast(BakedScene, Ray, RoundedRay, SceneFilter)             espalier_scene_raycast_rounded
    raycast(BakedScene, span<Ray>, span<InScene<RayHit>>, SceneFilter) espalier_scene_raycast_batch
    occluded(BakedScene, Ray, SceneFilter)                        espalier_scene_occluded
    occluded(BakedScene, Ray, RoundedRay, SceneFilter)            espalier_scene_occluded_rounded
    for_each_hit(BakedScene, Ray, Visitor<InstanceId, RayHit>, SceneFilter) espalier_scene_for_each_hit
    for_each_hit(BakedScene, Ray, RoundedRay, Visitor<InstanceId, RayHit>, SceneFilter)
        espalier_scene_for_each_hit_rounded
    closest_point(BakedScene, Vec3, float, uint32_t)              espalier_scene_closest_point
    for_each_candidate(BakedScene, Box, Visitor<InstanceId>, uint32_t) espalier_scene_for_each_candidate

    Shape: Sphere Capsule Box OrientedBox ConvexHull
    sweep(BakedScene, Shape, Vec3, SceneFilter)                   espalier_scene_sweep_shape
    sweep(BakedScene, Shape, Vec3, SceneSweepOptions)             espalier_scene_sweep_shape_with_options

    Shape: Sphere Capsule Box OrientedBox Cone Triangle
    overlaps(BakedScene, Shape, SceneFilter)                      espalier_scene_overlaps_shape
    for_each_overlap(BakedScene, Shape, Visitor<InstanceId, TriangleId>, SceneFilter)
        espalier_scene_for_each_overlap_shape

    moving_scene_bytes(uint32_t)                                  espalier_moving_scene_bytes
    least_moving_scene_bytes(uint32_t)                            espalier_least_moving_scene_bytes
    create_moving_scene(span<byte>, uint32_t, int, span<Blob>, span<BakedScene>) espalier_create_moving_scene
    open_moving_scene(span<byte>, span<Blob>, span<BakedScene>)   espalier_open_moving_scene
    MovingScene::instance_count()                                 espalier_moving_scene_instance_count
    MovingScene::capacity()                                       espalier_moving_scene_capacity
    MovingScene::slot_end()                                       espalier_moving_scene_slot_end
    MovingScene::step_exponent()                                  espalier_moving_scene_step_exponent
    MovingScene::must_refit()                                     espalier_moving_scene_must_refit
    MovingScene::bytes()                                          espalier_moving_scene_block
    MovingScene::meshes()                                         espalier_moving_scene_meshes
    MovingScene::tiles()                                          espalier_moving_scene_tiles
    insert(MovingScene, Instance)                                 espalier_moving_scene_insert
    remove(MovingScene, InstanceHandle)                           espalier_moving_scene_remove
    move(MovingScene, InstanceHandle, Transform)                  espalier_moving_scene_move
    move(MovingScene, span<Movement>)                             espalier_moving_scene_move_batch
    move_instances_of(MovingScene, uint32_t)                      espalier_moving_scene_move_instances_of
    set_mask(MovingScene, InstanceHandle, uint32_t)               espalier_moving_scene_set_mask
    set_user(MovingScene, InstanceHandle, uint32_t)               espalier_moving_scene_set_user
    refit(MovingScene)                                            espalier_moving_scene_refit
    repack(MovingScene)                                           espalier_moving_scene_repack
    quality(MovingScene)                                          espalier_moving_scene_quality
    end_step(MovingScene)                                         espalier_moving_scene_end_step
    handle_of(MovingScene, uint32_t)                              espalier_moving_scene_handle_of
    instance_at(MovingScene, InstanceHandle)                      espalier_moving_scene_instance_at
    instance_at(MovingScene, InstanceId)                          espalier_moving_scene_instance_of_id
    box_of(MovingScene, InstanceHandle)                           espalier_moving_scene_box_of

    raycast(MovingScene, Ray, SceneFilter)                        espalier_scene_raycast
    raycast(MovingScene, Ray, RoundedRay, SceneFilter)            espalier_scene_raycast_rounded
    raycast(MovingScene, span<Ray>, span<InScene<RayHit>>, SceneFilter) espalier_scene_raycast_batch
    occluded(MovingScene, Ray, SceneFilter)                       espalier_scene_occluded
    occluded(MovingScene, Ray, RoundedRay, SceneFilter)           espalier_scene_occluded_rounded
    for_each_hit(MovingScene, Ray, Visitor<InstanceId, RayHit>, SceneFilter) espalier_scene_for_each_hit
    for_each_hit(MovingScene, Ray, RoundedRay, Visitor<InstanceId, RayHit>, SceneFilter)
        espalier_scene_for_each_hit_rounded
    closest_point(MovingScene, Vec3, float, uint32_t)             espalier_scene_closest_point
    for_each_candidate(MovingScene, Box, Visitor<InstanceId>, uint32_t) espalier_scene_for_each_candidate

    Shape: Sphere Capsule Box OrientedBox ConvexHull
    sweep(MovingScene, Shape, Vec3, SceneFilter)                  espalier_scene_sweep_shape
    sweep(MovingScene, Shape, Vec3, SceneSweepOptions)            espalier_scene_sweep_shape_with_options

    Shape: Sphere Capsule Box OrientedBox Cone Triangle
    overlaps(MovingScene, Shape, SceneFilter)                     espalier_scene_overlaps_shape
    for_each_overlap(MovingScene, Shape, Visitor<InstanceId, TriangleId>, SceneFilter)
        espalier_scene_for_each_overlap_shape

    FilledPairs::in(auto)                                         -
    collect_candidate_pairs(MovingScene, span<InstancePair>, PairFilter, InstancePair) espalier_collect_candidate_pairs
    collect_colliding_pairs(MovingScene, span<InstancePair>, WorkLimit, PairFilter, InstancePair)
        espalier_collect_colliding_pairs
    collect_candidate_pairs(MovingScene, span<InstancePair>, SceneCounters, PairFilter, InstancePair)
        espalier_collect_candidate_pairs_counted
    collect_colliding_pairs(MovingScene, span<InstancePair>, WorkLimit, SceneCounters, PairCounters, PairFilter, InstancePair)
        espalier_collect_colliding_pairs_counted
    collect_candidate_pairs(MovingScene, BakedScene, span<BakedPair>, PairFilter, BakedPair)
        espalier_collect_candidate_pairs_with_baked
    collect_colliding_pairs(MovingScene, BakedScene, span<BakedPair>, WorkLimit, PairFilter, BakedPair)
        espalier_collect_colliding_pairs_with_baked
)";

/// What C has instead of the defaults of C++ structures, of conversions to bool, of numbers that the compiler counts
/// and of queries that take either scene; and the baker, whose bake.hpp is compared elsewhere.
const std::set<std::string> only_in_c = {"espalier_abi",
                                         "espalier_version",
                                         "espalier_size_of",
                                         "espalier_default_ray",
                                         "espalier_identity",
                                         "espalier_moving_scene_is_open",
                                         "espalier_moving_scene_view",
                                         "espalier_bake",
                                         "espalier_bake_scene",
                                         "espalier_describe_bake_status",
                                         "espalier_init_bake_options",
                                         "espalier_init_mesh_view",
                                         "espalier_release_bake_result",
                                         "espalier_size_of_baking",
                                         "espalier_verify",
                                         "espalier_verify_scene"};
/// Headers without queries: the baker's, the bytes of a blob, a type of parameters, numbers.
const std::set<std::string> other_headers = {"bake.hpp", "format.hpp", "function_ref.hpp"};

std::string text_of(const Path& path) {
    std::ifstream file(path);
    REQUIRE_MESSAGE(file, path.string() << " cannot be read");
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

std::string replaced(const std::string& text, const char* pattern, const char* by) {
    return std::regex_replace(text, std::regex(pattern), by);
}

/// Without comments, preprocessor lines and the library's own namespace; blanks are one blank.
std::string plain_code(const Path& header) {
    std::istringstream lines(text_of(header));
    std::string code;
    bool detail = false;
    for (std::string line; std::getline(lines, line);) {
        if (line == "namespace detail {") detail = true;
        if (!detail && !line.starts_with("#")) code += replaced(line, "//.*", "") + ' ';
        if (line == "}  // namespace detail") detail = false;
    }
    return replaced(code, "\\s+", " ");
}

/// Where a bracket that is opened before `from` is closed.
std::size_t end_of_brackets(const std::string& code, std::size_t from) {
    int open = 1;
    for (; from < code.size() && open > 0; ++from) {
        if (code[from] == '(') ++open;
        if (code[from] == ')') --open;
    }
    return from;
}

/// "const Blob& blob, std::span<const Ray> rays = {}" as "Blob, span<Ray>".
std::string types_of(std::string parameters) {
    parameters = replaced(parameters, "\\bconst |std::|[&*]", "");
    std::string types, one;
    int open = 0;
    for (const char c : parameters + ',') {
        if (c == '(' || c == '<') ++open;
        if (c == ')' || c == '>') --open;
        if (c != ',' || open > 0) {
            one += c;
            continue;
        }
        one = replaced(one, " =.*", "");
        one = replaced(one, "^ +", "");
        one = replaced(one, " [a-z_]+$", "");
        if (!one.empty()) types += (types.empty() ? "" : ", ") + one;
        one.clear();
    }
    return types;
}

/// The shapes that a concept names.
std::set<std::string> shapes_of(const std::string& concept_text) {
    const std::regex shape("same_as<Shape, (\\w+)>");
    std::set<std::string> shapes;
    for (std::sregex_iterator match(concept_text.begin(), concept_text.end(), shape), end; match != end; ++match)
        shapes.insert((*match)[1]);
    return shapes;
}

/// The shapes that the last template in the code before a place takes: those of its concept, or of the code if it
/// names none.
std::set<std::string> shapes_before(const std::string& code, std::size_t place) {
    static const std::map<std::string, Path> headers = {
        {"OverlapShape", "shapes.hpp"}, {"SweptShape", "sweep.hpp"}, {"SceneShape", "scene.hpp"}};
    const std::size_t begin = code.rfind("template <", place);
    const std::size_t name = begin + std::string("template <").size();
    const std::string of_template = code.substr(name, code.find(' ', name) - name);
    if (of_template == "class") return shapes_of(code);
    const std::string text = text_of(project / "lib/espalier" / headers.at(of_template));
    const std::size_t definition = text.find("concept " + of_template + " =");
    return shapes_of(text.substr(definition, text.find(';', definition) - definition));
}

/// The class around a place in the code and "::"; nothing for a friend, and where there is no class.
std::string class_around(const std::string& code, std::size_t place) {
    const std::regex type("(?:^|> )(?:class|struct) (?:\\[\\[\\w+\\]\\] )?(\\w+)$");
    std::vector<std::string> open;
    std::size_t begin = 0;  // of a declaration or statement
    for (std::size_t i = 0; i < place; ++i) {
        std::smatch match;
        if (code[i] == '{') {
            const std::string head = replaced(code.substr(begin, i - begin), "^ +| +$", "");
            open.push_back(std::regex_search(head, match, type) ? match[1].str() + "::" : "");
        } else if (code[i] == '}' && !open.empty()) {
            open.pop_back();
        }
        if (code[i] == '{' || code[i] == '}' || code[i] == ';') begin = i + 1;
    }
    if (code.substr(begin, place - begin).find("friend ") != std::string::npos) return {};
    while (!open.empty() && open.back().empty()) open.pop_back();
    return open.empty() ? std::string() : open.back();
}

/// Every function that a header declares, "overlaps(Blob, Sphere)", "Blob::size()". Conversions have no class.
std::set<std::string> functions_of(const Path& header) {
    const std::string code = plain_code(header);
    const std::regex name("([A-Za-z_0-9>&*]+) ([a-z_0-9]+)\\(");
    std::set<std::string> functions;
    for (std::sregex_iterator match(code.begin(), code.end(), name), end; match != end; ++match) {
        if ((*match)[1] == "return") continue;
        const auto first = static_cast<std::size_t>(match->position() + match->length());
        const std::size_t last = end_of_brackets(code, first);
        if (!std::regex_search(code.substr(last, 24), std::regex("^( const)?( noexcept)? ?[;{]"))) continue;
        std::string function = (*match)[2].str() + '(' + types_of(code.substr(first, last - first - 1)) + ')';
        if ((*match)[1] != "operator")
            function = class_around(code, static_cast<std::size_t>(match->position())) + function;
        if (!std::regex_search(function, std::regex(", Shape\\b"))) functions.insert(function);
        else
            for (const std::string& shape : shapes_before(code, static_cast<std::size_t>(match->position())))
                functions.insert(replaced(function, "\\bShape\\b", shape.c_str()));
    }
    return functions;
}

/// The headers that espalier.h includes, one after the other, without comments.
std::string c_headers() {
    std::string text;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(project / "lib/espalier/c"))
        if (entry.is_regular_file()) text += replaced(text_of(entry.path()), "/\\*[^]*?\\*/", "");
    return text;
}

std::set<std::string> c_functions() {
    const std::string header = c_headers();
    const std::regex declaration("\\b(espalier_[a-z_0-9]+)\\(");
    std::set<std::string> functions;
    for (std::sregex_iterator match(header.begin(), header.end(), declaration), end; match != end; ++match)
        functions.insert((*match)[1]);
    return functions;
}

/// "OrientedBox" as "oriented_box".
std::string name_in_c(const std::string& shape) {
    std::string name = replaced(shape, "([a-z])([A-Z])", "$1_$2");
    for (char& c : name)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return name;
}

/// Returns what C has for each function of C++, of each shape.
std::map<std::string, std::string> counterparts() {
    const std::vector<std::string> none = {"Shape"};
    std::vector<std::string> shapes = none;
    std::map<std::string, std::string> result;
    std::istringstream lines(replaced(table, "\\)\n", ") "));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string first;
        if (!(words >> first)) {
            shapes = none;
        } else if (first == "Shape:") {
            shapes.assign(std::istream_iterator<std::string>(words), {});
        } else {
            const std::size_t begin = line.find(first), end = line.rfind(')') + 1;
            const std::string in_cpp = line.substr(begin, end - begin);
            const std::string in_c = line.substr(line.find_first_not_of(' ', end));
            for (const std::string& shape : shapes)
                result[replaced(in_cpp, "\\bShape\\b", shape.c_str())] =
                    replaced(in_c, "_shape", ('_' + name_in_c(shape)).c_str());
        }
    }
    return result;
}

/// The source, and again for each shape that its macro ASK or SWEEP is used for, with the shape in the functions'
/// names.
std::string expanded(const std::string& source) {
    std::string result = source;
    const std::regex use("(?:ASK|SWEEP)\\(([a-z_]+), &?[a-z]");
    for (std::sregex_iterator match(source.begin(), source.end(), use), end; match != end; ++match)
        result += replaced(source, "##shape(##)?", (*match)[1].str().c_str());
    return result;
}

std::set<std::string> cpp_functions() {
    std::set<std::string> functions;
    for (const char* const folder : {"lib/espalier", "lib/espalier/scenes", "lib/espalier/batches"})
        for (const auto& entry : std::filesystem::directory_iterator(project / folder)) {
            const Path& header = entry.path();
            if (header.extension() != ".hpp" || other_headers.count(header.filename().string()) != 0) continue;
            functions.merge(functions_of(header));
        }
    return functions;
}

std::string upper(std::string text) {
    for (char& c : text)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return text;
}

/// How enumerators begin in C.
const std::map<std::string, std::string> prefixes = {{"OpenStatus", "ESPALIER_OPEN_"},
                                                     {"QueryStatus", "ESPALIER_QUERY_"},
                                                     {"Feature", "ESPALIER_FEATURE_"},
                                                     {"Visit", "ESPALIER_VISIT_"},
                                                     {"Profile", "ESPALIER_PROFILE_"},
                                                     {"EdgeKind", "ESPALIER_EDGE_"},
                                                     {"FaceCulling", "ESPALIER_FACE_CULLING_"},
                                                     {"NodeVisit", "ESPALIER_NODE_"},
                                                     {"Side", "ESPALIER_SIDE_"}};

}  // namespace

TEST_SUITE("counterparts") {
    TEST_CASE("c api: every enumerator of the C++ headers has a counterpart") {
        const std::string in_c = c_headers();
        const std::regex enumeration("enum class (?:\\[\\[nodiscard\\]\\] )?(\\w+) : std::uint8_t ?\\{([^}]*)\\}"),
            enumerator("\\w+");
        std::size_t enumerations = 0;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(project / "lib/espalier")) {
            const std::string header = entry.path().filename().string();
            if (entry.path().extension() != ".hpp" || header == "bake.hpp") continue;
            const std::string code = plain_code(entry.path());
            for (std::sregex_iterator match(code.begin(), code.end(), enumeration), end; match != end; ++match) {
                const std::string name = (*match)[1];
                REQUIRE_MESSAGE(prefixes.count(name) == 1, name << " of " << header << " has no counterpart");
                ++enumerations;
                const std::string values = replaced((*match)[2], " = [0-9]+", "");
                for (std::sregex_iterator value(values.begin(), values.end(), enumerator); value != end; ++value) {
                    const std::string in_upper = prefixes.at(name) + upper(value->str());
                    CHECK_MESSAGE(std::regex_search(in_c, std::regex("\\b" + in_upper + " = ")),
                                  "espalier/c lacks " << in_upper);
                }
            }
        }
        CHECK(enumerations == prefixes.size());
    }

    TEST_CASE("c api: every query of the C++ headers has a counterpart") {
        const std::set<std::string> functions = cpp_functions(), in_c = c_functions();
        const std::map<std::string, std::string> listed = counterparts();
        REQUIRE(functions.size() > 80);
        for (const std::string& function : functions)
            CHECK_MESSAGE(listed.count(function) == 1, function << " has no counterpart");
        for (const auto& entry : listed) {
            const std::string &function = entry.first, &counterpart = entry.second;  // bindings cannot be captured
            CHECK_MESSAGE(functions.count(function) == 1, "no header declares " << function);
            CHECK_MESSAGE((counterpart == "-" || in_c.count(counterpart) == 1), "espalier/c lacks " << counterpart);
        }
    }

    TEST_CASE("c api: every function is the counterpart of a query and is called by a test") {
        std::set<std::string> known = only_in_c;
        for (const auto& [function, counterpart] : counterparts()) {
            known.insert(counterpart);
            if (function.ends_with("TriangleFilter)")) known.insert(counterpart + "_filtered");  // C has no defaults
        }
        std::string asked;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(project / "tests/c"))
            if (entry.path().extension() == ".c") asked += expanded(text_of(entry.path()));
        for (const std::string& function : c_functions()) {
            CHECK_MESSAGE(known.count(function) == 1, function << " is the counterpart of nothing");
            CHECK_MESSAGE(asked.find(function + '(') != std::string::npos, function << " is never asked");
        }
    }
}
