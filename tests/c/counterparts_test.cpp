// Claims about what espalier.h has: a function for each that the C++ headers have, and each of them is asked. Read from
// the headers themselves, so that a query that is added for C++ alone is noticed.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

using Path = std::filesystem::path;

namespace {

const Path project = ESPALIER_PROJECT_FOLDER;

/// What C++ has and what C has for it. `-` where C needs none.
const char* const counterparts = R"(
    describe(OpenStatus)                                              espalier_describe_open_status
    describe(QueryStatus)                                         espalier_describe_query_status

    is_refused(QueryStatus)                                       espalier_is_refused
    yes()                                                         espalier_yes
    no()                                                          espalier_no
    value_or(bool)                                                -
    of(bool)                                                      -
    in(auto)                                                      -
    bool()                                                        -

    open(span<byte>)                                              espalier_open
    open_unchecked(span<byte>)                                    espalier_open_unchecked
    status()                                                      espalier_blob_status
    triangle_count()                                              espalier_blob_triangle_count
    duplicate_reference_count()                                   espalier_blob_duplicate_reference_count
    vertex_count()                                                espalier_blob_vertex_count
    size()                                                        espalier_blob_size
    checksum()                                                    espalier_blob_checksum
    depth()                                                       espalier_blob_depth
    profile()                                                     espalier_blob_profile
    lattice()                                                     espalier_blob_lattice
    max_error()                                                   espalier_blob_max_error
    bounds()                                                      espalier_blob_bounds
    is_closed()                                                   espalier_blob_is_closed
    has_original_ids()                                            espalier_blob_has_original_ids
    has_materials()                                               espalier_blob_has_materials
    has_edge_flags()                                              espalier_blob_has_edge_flags
    material(Blob, TriangleId)                                    espalier_material

    edge_kinds(Blob, TriangleId)                                  espalier_edge_kinds_of
    fix_internal_edge_normal(Blob, TriangleId, Feature, Vec3)     espalier_fix_internal_edge_normal

    bounding_sphere(Blob)                                         espalier_bounding_sphere
    oriented_bounds(Blob)                                         espalier_oriented_bounds
    k_dop_bounds(Blob)                                            espalier_k_dop_bounds

    between(Vec3, Vec3)                                           espalier_ray_between
    raycast(Blob, Ray)                                            espalier_raycast
    raycast(Blob, Ray, TriangleFilter)                            espalier_raycast_filtered
    occluded(Blob, Ray)                                           espalier_occluded
    occluded(Blob, Ray, TriangleFilter)                           espalier_occluded_filtered
    closest_hits(Blob, Ray, span<RayHit>)                         espalier_closest_hits
    closest_hits(Blob, Ray, span<RayHit>, TriangleFilter)         espalier_closest_hits_filtered
    for_each_hit(Blob, Ray, Visitor<RayHit>)                      espalier_for_each_hit
    raycast(Blob, span<Ray>, span<RayHit>)                        espalier_raycast_batch
    occluded(Blob, span<Ray>, span<YesNo>)                        espalier_occluded_batch

    original_triangle(Blob, TriangleId)                           espalier_original_triangle_of
    original_triangle(Blob, span<TriangleId>, span<Result<OriginalTriangle>>) espalier_original_triangle_of_batch
    original_hit(Blob, RayHit)                                    espalier_original_hit_of
    original_hit(Blob, span<RayHit>, span<OriginalHit>)           espalier_original_hit_of_batch
    original_hit(span<OriginalTriangle>, RayHit)                  espalier_original_hit_by_remap
    bool()                                                        -
    read_remap(span<byte>, Blob, span<OriginalTriangle>)          espalier_read_remap

    overlaps(Blob, Sphere)   espalier_overlaps_sphere
    overlaps(Blob, Capsule)   espalier_overlaps_capsule
    overlaps(Blob, Box)   espalier_overlaps_box
    overlaps(Blob, OrientedBox)   espalier_overlaps_oriented_box
    overlaps(Blob, Cone)   espalier_overlaps_cone
    overlaps(Blob, Triangle)   espalier_overlaps_triangle
    overlaps(Blob, ConvexVolume)   espalier_overlaps_convex_volume
    overlaps(Blob, LatticeBox)   espalier_overlaps_lattice_box
    for_each_overlap(Blob, Sphere, TriangleVisitor)   espalier_for_each_overlap_sphere
    for_each_overlap(Blob, Capsule, TriangleVisitor)   espalier_for_each_overlap_capsule
    for_each_overlap(Blob, Box, TriangleVisitor)   espalier_for_each_overlap_box
    for_each_overlap(Blob, OrientedBox, TriangleVisitor)   espalier_for_each_overlap_oriented_box
    for_each_overlap(Blob, Cone, TriangleVisitor)   espalier_for_each_overlap_cone
    for_each_overlap(Blob, Triangle, TriangleVisitor)   espalier_for_each_overlap_triangle
    for_each_overlap(Blob, ConvexVolume, TriangleVisitor)   espalier_for_each_overlap_convex_volume
    for_each_overlap(Blob, LatticeBox, TriangleVisitor)   espalier_for_each_overlap_lattice_box
    collect_overlaps(Blob, Sphere, span<TriangleId>, Cursor)   espalier_collect_overlaps_sphere
    collect_overlaps(Blob, Capsule, span<TriangleId>, Cursor)   espalier_collect_overlaps_capsule
    collect_overlaps(Blob, Box, span<TriangleId>, Cursor)   espalier_collect_overlaps_box
    collect_overlaps(Blob, OrientedBox, span<TriangleId>, Cursor)   espalier_collect_overlaps_oriented_box
    collect_overlaps(Blob, Cone, span<TriangleId>, Cursor)   espalier_collect_overlaps_cone
    collect_overlaps(Blob, Triangle, span<TriangleId>, Cursor)   espalier_collect_overlaps_triangle
    collect_overlaps(Blob, ConvexVolume, span<TriangleId>, Cursor)   espalier_collect_overlaps_convex_volume
    collect_overlaps(Blob, LatticeBox, span<TriangleId>, Cursor)   espalier_collect_overlaps_lattice_box

    closest_point(Blob, Vec3, float)                              espalier_closest_point
    closest_point(Blob, Segment, float)                           espalier_closest_point_segment
    closest_point(Blob, Box, float)                               espalier_closest_point_box
    closest_triangles(Blob, Vec3, span<ClosestPoint>, float)      espalier_closest_triangles
    contains(Blob, Vec3)                                          espalier_contains
    signed_distance(Blob, Vec3, float)                            espalier_signed_distance

    rounding_error(Blob, Vec3)                                    espalier_rounding_error_point
    rounding_error(Blob, Ray)                                     espalier_rounding_error_ray
    rounding_error(Blob, Segment)                                 espalier_rounding_error_segment
    rounding_error(Blob, Sphere)                                  espalier_rounding_error_sphere
    rounding_error(Blob, Capsule)                                 espalier_rounding_error_capsule
    rounding_error(Blob, Box)                                     espalier_rounding_error_box
    rounding_error(Blob, OrientedBox)                             espalier_rounding_error_oriented_box
    rounding_error(Blob, Triangle)                                espalier_rounding_error_triangle
    rounding_error(Blob, Sphere, Vec3)                            espalier_rounding_error_sweep_sphere
    rounding_error(Blob, Capsule, Vec3)                           espalier_rounding_error_sweep_capsule
    rounding_error(Blob, Box, Vec3)                               espalier_rounding_error_sweep_box

    sweep(Blob, Sphere, Vec3, TriangleFilter)                     espalier_sweep_sphere
    sweep(Blob, Capsule, Vec3, TriangleFilter)                    espalier_sweep_capsule
    sweep(Blob, Box, Vec3, TriangleFilter)                        espalier_sweep_box

    blob()                                                        -
    transform()                                                   -
    to_local(Transform, Vec3)                                     espalier_to_local_point
    to_local(Transform, Segment)                                  espalier_to_local_segment
    to_local(Transform, Sphere)                                   espalier_to_local_sphere
    to_local(Transform, Capsule)                                  espalier_to_local_capsule
    to_local(Transform, Triangle)                                 espalier_to_local_triangle
    to_local(Transform, Box)                                      espalier_to_local_box
    to_local(Transform, OrientedBox)                              espalier_to_local_oriented_box
    to_local(Transform, Cone)                                     espalier_to_local_cone
    to_local(Transform, Plane)                                    espalier_to_local_plane
    to_local(Transform, Ray)                                      espalier_to_local_ray
    to_local(Transform, Transform)                                espalier_to_local_transform
    direction_to_local(Transform, Vec3)                           espalier_direction_to_local
    to_world(Transform, Vec3)                                     espalier_to_world_point
    direction_to_world(Transform, Vec3)                           espalier_direction_to_world
    normal_to_world(Transform, Vec3)                              espalier_normal_to_world
    translated(Vec3, Vec3)                                        espalier_translated_point
    translated(Segment, Vec3)                                     espalier_translated_segment
    translated(Sphere, Vec3)                                      espalier_translated_sphere
    translated(Capsule, Vec3)                                     espalier_translated_capsule
    translated(Triangle, Vec3)                                    espalier_translated_triangle
    translated(Box, Vec3)                                         espalier_translated_box
    translated(OrientedBox, Vec3)                                 espalier_translated_oriented_box
    translated(Cone, Vec3)                                        espalier_translated_cone
    translated(Ray, Vec3)                                         espalier_translated_ray
    transform_from_matrix(float (rows)[3][4])                     espalier_transform_from_matrix

    unlimited()                                                   -
    visits()                                                      -
    overlaps(PlacedBlob, PlacedBlob, WorkLimit)                   espalier_overlaps_blob
    first_contact(PlacedBlob, PlacedBlob, WorkLimit)              espalier_first_contact
    for_each_contact(PlacedBlob, PlacedBlob, Visitor<PairContact>, WorkLimit) espalier_for_each_contact
    collect_contacts(PlacedBlob, PlacedBlob, span<PairContact>, WorkLimit, Cursor) espalier_collect_contacts
    distance(PlacedBlob, PlacedBlob, WorkLimit, float)            espalier_distance
    within_distance(PlacedBlob, PlacedBlob, float, WorkLimit)     espalier_within_distance

    raycast(Blob, Ray, QueryCounters)                             espalier_raycast_counted
    count_node()                                                  -
    count_leaf()                                                  -
    count_triangles(unsigned)                                     -
    count_candidates(unsigned)                                    -
    overlaps(Blob, Sphere, Accuracy, QueryCounters)   espalier_overlaps_sphere_approximate
    overlaps(Blob, Box, Accuracy, QueryCounters)   espalier_overlaps_box_approximate
    occluded(Blob, Ray, Accuracy, QueryCounters)                  espalier_occluded_approximate
    distance_bounds(Blob, Vec3, float, Accuracy, QueryCounters)   espalier_distance_bounds

    for_each_triangle(Blob, TriangleVisitor)   espalier_for_each_triangle
    triangle_at(Blob, TriangleId)   espalier_triangle_at
    for_each_node(Blob, FunctionRef<NodeVisit(TreeNode)>)         espalier_for_each_node

    to_lattice(Lattice, Vec3)                                     espalier_to_lattice_point
    to_lattice(Lattice, Box)                                      espalier_to_lattice_box
    to_local(Lattice, LatticePoint)                               espalier_to_local
    lattice_of(span<Blob>)                                        espalier_lattice_of_blobs
    round_ray(Lattice, Ray)                                       espalier_round_ray
    data()                                                        -
    raycast(Blob, RoundedRay)                                     espalier_raycast_rounded
    occluded(Blob, RoundedRay)                                    espalier_occluded_rounded
    raycast(Blob, Segment)                                        espalier_raycast_lattice_segment
    occluded(Blob, Segment)                                       espalier_occluded_lattice_segment
)";

/// What C has instead of the defaults of C++ structures.
const std::set<std::string> only_in_c = {"espalier_abi", "espalier_default_ray", "espalier_identity",
                                         "espalier_rounded_ray_status"};
/// Headers without queries: the baker's, the bytes of a blob, a type of parameters, numbers.
const std::set<std::string> other_headers = {"bake.hpp", "format.hpp", "function_ref.hpp", "version.hpp"};

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

/// The shapes that the templates of a header take: those that it names itself, else all that overlaps take.
std::set<std::string> shapes_of(const std::string& code) {
    const std::regex shape("same_as<Shape, (\\w+)>");
    std::set<std::string> shapes;
    for (std::sregex_iterator match(code.begin(), code.end(), shape), end; match != end; ++match)
        shapes.insert((*match)[1]);
    return shapes.empty() ? shapes_of(text_of(project / "lib/espalier/shapes.hpp")) : shapes;
}

/// Every function that a header declares, "overlaps(Blob, Sphere)".
std::set<std::string> functions_of(const Path& header) {
    const std::string code = plain_code(header);
    const std::regex name("([A-Za-z_0-9>&*]+) ([a-z_0-9]+)\\(");
    std::set<std::string> functions;
    for (std::sregex_iterator match(code.begin(), code.end(), name), end; match != end; ++match) {
        if ((*match)[1] == "return") continue;
        const auto first = static_cast<std::size_t>(match->position() + match->length());
        const std::size_t last = end_of_brackets(code, first);
        if (!std::regex_search(code.substr(last, 24), std::regex("^( const)?( noexcept)? ?[;{]"))) continue;
        const std::string function = (*match)[2].str() + '(' + types_of(code.substr(first, last - first - 1)) + ')';
        if (!std::regex_search(function, std::regex(", Shape\\b"))) functions.insert(function);
        else
            for (const std::string& shape : shapes_of(code))
                functions.insert(replaced(function, "\\bShape\\b", shape.c_str()));
    }
    return functions;
}

/// The headers that espalier.h includes, one after the other, without comments.
std::string c_headers() {
    std::string text;
    for (const auto& entry : std::filesystem::directory_iterator(project / "lib/espalier/c"))
        text += replaced(text_of(entry.path()), "/\\*[^]*?\\*/", "");
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

/// The table above.
std::map<std::string, std::string> listed() {
    std::map<std::string, std::string> result;
    std::istringstream lines(counterparts);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t first = line.find_first_not_of(' ');
        if (first == std::string::npos) continue;
        const std::size_t end = line.rfind(')') + 1;
        result[line.substr(first, end - first)] = line.substr(line.find_first_not_of(' ', end));
    }
    return result;
}

/// The source, and again for each shape that its macro ASK is used for, with the shape in the functions' names.
std::string expanded(const std::string& source) {
    std::string result = source;
    const std::regex use("ASK\\(([a-z_]+), &?[a-z]");
    for (std::sregex_iterator match(source.begin(), source.end(), use), end; match != end; ++match)
        result += replaced(source, "##shape(##)?", (*match)[1].str().c_str());
    return result;
}

std::set<std::string> cpp_functions() {
    std::set<std::string> functions;
    for (const auto& entry : std::filesystem::directory_iterator(project / "lib/espalier")) {
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
        for (const auto& entry : std::filesystem::directory_iterator(project / "lib/espalier")) {
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
        const std::map<std::string, std::string> table = listed();
        REQUIRE(functions.size() > 80);
        for (const std::string& function : functions)
            CHECK_MESSAGE(table.count(function) == 1, function << " has no counterpart");
        for (const auto& entry : table) {
            const std::string &function = entry.first, &counterpart = entry.second;  // bindings cannot be captured
            CHECK_MESSAGE(functions.count(function) == 1, "no header declares " << function);
            CHECK_MESSAGE((counterpart == "-" || in_c.count(counterpart) == 1), "espalier/c lacks " << counterpart);
        }
    }

    TEST_CASE("c api: every function is the counterpart of a query and is called by a test") {
        std::set<std::string> known = only_in_c;
        for (const auto& [function, counterpart] : listed()) {
            known.insert(counterpart);
            if (function.ends_with("TriangleFilter)")) known.insert(counterpart + "_filtered");  // C has no defaults
        }
        std::string asked;
        for (const auto& entry : std::filesystem::directory_iterator(project / "tests/c"))
            if (entry.path().extension() == ".c") asked += expanded(text_of(entry.path()));
        for (const std::string& function : c_functions()) {
            CHECK_MESSAGE(known.count(function) == 1, function << " is the counterpart of nothing");
            CHECK_MESSAGE(asked.find(function + '(') != std::string::npos, function << " is never asked");
        }
    }
}
