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
    describe(Status)                                              espalier_describe_status
    describe(QueryStatus)                                         espalier_describe_query_status

    bool()                                                        -

    open(span<byte>, Blob)                                        espalier_open
    open_trusted_image(span<byte>, Blob)                          espalier_open_trusted_image
    triangle_count()                                              espalier_blob_triangle_count
    copy_count()                                                  espalier_blob_copy_count
    vertex_count()                                                espalier_blob_vertex_count
    size_bytes()                                                  espalier_blob_size_bytes
    checksum()                                                    espalier_blob_checksum
    depth()                                                       espalier_blob_depth
    bits()                                                        espalier_blob_bits
    profile()                                                     espalier_blob_profile
    step()                                                        espalier_blob_step
    max_error()                                                   espalier_blob_max_error
    bounds_min()                                                  espalier_blob_bounds_min
    bounds_max()                                                  espalier_blob_bounds_max
    closed()                                                      espalier_blob_closed
    has_original_ids()                                            espalier_blob_has_original_ids
    has_materials()                                               espalier_blob_has_materials
    has_edge_flags()                                              espalier_blob_has_edge_flags
    data()                                                        -
    material(Blob, Triangle)                                      espalier_material

    edge_kinds(Blob, Triangle, EdgeKinds)                         espalier_get_edge_kinds
    is_on_inner_edge(Blob, Contact, Vec3)                         espalier_is_on_inner_edge

    bounding_sphere(Blob, Sphere)                                 espalier_bounding_sphere
    oriented_bounds(Blob, OrientedBox)                            espalier_oriented_bounds
    k_dop_bounds(Blob, KDop)                                      espalier_k_dop_bounds
    is_outside_bounds(Blob, Sphere)                               espalier_is_outside_bounds_sphere
    is_outside_bounds(Blob, Box)                                  espalier_is_outside_bounds_box

    raycast(Blob, Ray, RayHit)                                    espalier_raycast
    raycast(Blob, Ray, RayHit, TriangleFilter)                    espalier_raycast_filtered
    occluded(Blob, Ray)                                           espalier_occluded
    occluded(Blob, Ray, TriangleFilter)                           espalier_occluded_filtered
    along(Segment)                                                espalier_along
    raycast(Blob, S, RayHit)                                      espalier_along
    occluded(Blob, S)                                             espalier_along
    closest_hits(Blob, Ray, span<RayHit>)                         espalier_closest_hits
    closest_hits(Blob, Ray, span<RayHit>, TriangleFilter)         espalier_closest_hits_filtered
    raycast(Blob, span<Ray>, span<RayHit>)                        espalier_raycast_batch
    occluded(Blob, span<Ray>, span<uint8_t>)                      espalier_occluded_batch
    for_each_hit(Blob, Ray, FunctionRef<Visit(RayHit)>)           espalier_for_each_hit

    original_triangle(Blob, Triangle, OriginalTriangle)           espalier_get_original_triangle
    original_triangle(Blob, span<Triangle>, span<OriginalTriangle>) espalier_get_original_triangle_batch
    original_hit(Blob, RayHit)                                    espalier_get_original_hit
    original_hit(Blob, span<RayHit>, span<OriginalHit>)           espalier_get_original_hit_batch
    original_hit(span<OriginalTriangle>, RayHit)                  espalier_get_original_hit_by_remap
    bool()                                                        -
    read_remap(span<byte>, Blob, span<OriginalTriangle>)          espalier_read_remap

    overlaps(Blob, Sphere)                                        espalier_overlaps_sphere
    overlaps(Blob, Capsule)                                       espalier_overlaps_capsule
    overlaps(Blob, Box)                                           espalier_overlaps_box
    overlaps(Blob, OrientedBox)                                   espalier_overlaps_oriented_box
    overlaps(Blob, Corners)                                       espalier_overlaps_triangle
    overlaps(Blob, span<Plane>)                                   espalier_overlaps_planes
    for_each_overlap(Blob, Sphere, FunctionRef<Visit(Triangle)>)  espalier_for_each_overlap_sphere
    for_each_overlap(Blob, Capsule, FunctionRef<Visit(Triangle)>) espalier_for_each_overlap_capsule
    for_each_overlap(Blob, Box, FunctionRef<Visit(Triangle)>)     espalier_for_each_overlap_box
    for_each_overlap(Blob, OrientedBox, FunctionRef<Visit(Triangle)>) espalier_for_each_overlap_oriented_box
    for_each_overlap(Blob, Corners, FunctionRef<Visit(Triangle)>) espalier_for_each_overlap_triangle
    for_each_overlap(Blob, span<Plane>, FunctionRef<Visit(Triangle)>) espalier_for_each_overlap_planes
    collect_overlaps(Blob, Sphere, span<Triangle>, uint32_t)      espalier_collect_overlaps_sphere
    collect_overlaps(Blob, Capsule, span<Triangle>, uint32_t)     espalier_collect_overlaps_capsule
    collect_overlaps(Blob, Box, span<Triangle>, uint32_t)         espalier_collect_overlaps_box
    collect_overlaps(Blob, OrientedBox, span<Triangle>, uint32_t) espalier_collect_overlaps_oriented_box
    collect_overlaps(Blob, Corners, span<Triangle>, uint32_t)     espalier_collect_overlaps_triangle
    collect_overlaps(Blob, span<Plane>, span<Triangle>, uint32_t) espalier_collect_overlaps_planes

    closest_point(Blob, Vec3, float, Nearest)                     espalier_closest_point
    closest_triangles(Blob, Vec3, float, span<Nearest>)           espalier_closest_triangles
    closest_to_segment(Blob, Segment, float, NearestPair)         espalier_closest_to_segment
    closest_to_box(Blob, Box, float, NearestPair)                 espalier_closest_to_box
    contains(Blob, Vec3, bool)                                    espalier_contains
    signed_distance(Blob, Vec3, float, Nearest)                   espalier_signed_distance

    rounding_error(Blob, Vec3)                                    espalier_rounding_error_point
    rounding_error(Blob, Ray)                                     espalier_rounding_error_ray
    rounding_error(Blob, Segment)                                 espalier_rounding_error_segment
    rounding_error(Blob, Sphere)                                  espalier_rounding_error_sphere
    rounding_error(Blob, Capsule)                                 espalier_rounding_error_capsule
    rounding_error(Blob, Box)                                     espalier_rounding_error_box
    rounding_error(Blob, OrientedBox)                             espalier_rounding_error_oriented_box
    rounding_error(Blob, Corners)                                 espalier_rounding_error_triangle

    sweep(Blob, Sphere, Vec3, SweepHit)                           espalier_sweep_sphere
    sweep(Blob, Capsule, Vec3, SweepHit)                          espalier_sweep_capsule
    sweep(Blob, Box, Vec3, SweepHit)                              espalier_sweep_box
    sweep(Blob, Sphere, Vec3, SweepHit, TriangleFilter)           espalier_sweep_sphere_filtered
    sweep(Blob, Capsule, Vec3, SweepHit, TriangleFilter)          espalier_sweep_capsule_filtered
    sweep(Blob, Box, Vec3, SweepHit, TriangleFilter)              espalier_sweep_box_filtered
    check_sweep(Blob, Sphere, Vec3)                               espalier_check_sweep_sphere
    check_sweep(Blob, Capsule, Vec3)                              espalier_check_sweep_capsule
    check_sweep(Blob, Box, Vec3)                                  espalier_check_sweep_box

    collides(Blob, Blob, Placement, bool, WorkLimit)              espalier_collides
    first_contact(Blob, Blob, Placement, TrianglePair, bool, WorkLimit) espalier_first_contact
    for_each_contact(Blob, Blob, Placement, FunctionRef<Visit(TrianglePair)>, WorkLimit) espalier_for_each_contact
    all_contacts(Blob, Blob, Placement, span<TrianglePair>, size_t, WorkLimit) espalier_all_contacts
    minimum_distance(Blob, Blob, Placement, float, PairDistance, bool, WorkLimit) espalier_minimum_distance
    within_distance(Blob, Blob, Placement, float, bool, WorkLimit) espalier_within_distance

    raycast_counted(Blob, Ray, RayHit, QueryCounters)             espalier_raycast_counted
    count_node()                                                  -
    count_leaf()                                                  -
    count_triangles(unsigned)                                     -
    count_candidates(unsigned)                                    -
    may_overlap(Blob, Sphere, float, QueryCounters)               espalier_may_overlap_sphere
    may_overlap(Blob, Box, float, QueryCounters)                  espalier_may_overlap_box
    may_be_occluded(Blob, Ray, float, QueryCounters)              espalier_may_be_occluded
    distance_bounds(Blob, Vec3, float, float, DistanceBounds, QueryCounters) espalier_get_distance_bounds

    for_each_triangle(Blob, FunctionRef<Visit(Triangle, Corners)>) espalier_for_each_triangle
    triangle_corners(Blob, Triangle, Corners)                     espalier_triangle_corners
    for_each_node(Blob, FunctionRef<NodeVisit(TreeNode)>)         espalier_for_each_node

    lattice_of(Blob)                                              espalier_lattice_of
    to_steps(Lattice, Vec3, Steps)                                espalier_to_steps
    steps_around(Lattice, Box, BoxInSteps)                        espalier_steps_around
    to_world(Lattice, Steps)                                      espalier_to_world
    overlaps(Blob, BoxInSteps)                                    espalier_overlaps_box_in_steps
    for_each_overlap(Blob, BoxInSteps, FunctionRef<Visit(Triangle)>) espalier_for_each_overlap_box_in_steps
    collect_overlaps(Blob, BoxInSteps, span<Triangle>, uint32_t)  espalier_collect_overlaps_box_in_steps
    lattice_of(span<Blob>, Lattice)                               espalier_lattice_of_blobs
    round_ray(Lattice, Ray)                                       espalier_round_ray
    status()                                                      espalier_round_ray
    raycast(Blob, RoundedRay, RayHit)                             espalier_raycast_rounded
    occluded(Blob, RoundedRay, bool)                              espalier_occluded_rounded
    first_hit(Blob, SegmentInSteps, HitInSteps)                   espalier_first_hit
    any_hit(Blob, SegmentInSteps, bool)                           espalier_any_hit
)";

/// What C has instead of the defaults of C++ structures.
const std::set<std::string> only_in_c = {"espalier_ray_from", "espalier_unplaced"};
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
        functions.insert((*match)[2].str() + '(' + types_of(code.substr(first, last - first - 1)) + ')');
    }
    return functions;
}

std::set<std::string> c_functions() {
    const std::string header = replaced(text_of(project / "lib/espalier/espalier.h"), "/\\*[^/]*\\*/", "");
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
const std::map<std::string, std::string> prefixes = {
    {"Status", "ESPALIER_STATUS_"}, {"QueryStatus", "ESPALIER_QUERY_"}, {"Feature", "ESPALIER_FEATURE_"},
    {"Visit", "ESPALIER_"},         {"Profile", "ESPALIER_PROFILE_"},   {"EdgeKind", "ESPALIER_EDGE_"},
    {"Faces", "ESPALIER_FACES_"},   {"NodeVisit", "ESPALIER_NODE_"}};

}  // namespace

TEST_SUITE("counterparts") {
    TEST_CASE("c api: every enumerator of the C++ headers has a counterpart") {
        const std::string in_c = text_of(project / "lib/espalier/espalier.h");
        const std::regex enumeration("enum class (\\w+) : std::uint8_t \\{([^}]*)\\}"), enumerator("\\w+");
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
                                  "espalier.h lacks " << in_upper);
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
            CHECK_MESSAGE((counterpart == "-" || in_c.count(counterpart) == 1), "espalier.h lacks " << counterpart);
        }
    }

    TEST_CASE("c api: every function is the counterpart of a query and is called by a test") {
        std::set<std::string> known = only_in_c;
        for (const auto& [function, counterpart] : listed()) known.insert(counterpart);
        std::string asked;
        for (const auto& entry : std::filesystem::directory_iterator(project / "tests/c"))
            if (entry.path().extension() == ".c") asked += expanded(text_of(entry.path()));
        for (const std::string& function : c_functions()) {
            CHECK_MESSAGE(known.count(function) == 1, function << " is the counterpart of nothing");
            CHECK_MESSAGE(asked.find(function + '(') != std::string::npos, function << " is never asked");
        }
    }
}
