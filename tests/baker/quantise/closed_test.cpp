// Claims about the closed flag and what loses it; the judge is closed_check.hpp.
#include "support/testing.hpp"

#include <baker/bake_with.hpp>
#include <baker/base/float_rounding.hpp>
#include <baker/quantise/closed.hpp>

#include "baker/baking_support.hpp"
#include "closed_check.hpp"

namespace espalier::tests::closed_test {
namespace {

/// From 2^-`halvings` to 1, each order of magnitude as often.
float some_size(Random& random, std::uint32_t halvings) {
    return std::ldexp(1.0f + random.unit(), -1 - static_cast<int>(random.below(halvings)));
}

/// The smallest example: one of its triangles becomes three points on a line at 16 bits.
Mesh make_sliver_pyramid() {
    Mesh mesh = {.name = "sliver pyramid"};
    mesh.positions = {
        {0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, {0.5f, -1e-6f, 0.0f}};
    mesh.triangles = {{0, 1, 2}, {0, 4, 1}, {0, 3, 4}, {4, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    return mesh;
}

Mesh some_base(Random& random) {
    const auto kind = random.below(5);
    if (kind == 0) return make_cube(0.0f, 1.0f);
    if (kind == 1) return make_icosphere(1, 1.0, {0.0f, 0.0f, 0.0f});
    if (kind == 2) return make_torus(8, 5, 1.0, 0.3);
    if (kind == 3) return make_uv_sphere(4, 9, 1.0, {0.25f, 0.5f, 0.0f});
    return make_sliver_pyramid();
}

/// A turned, stretched, sheared copy: no axis of the lattice is special to it.
void transform(Mesh& mesh, Random& random) {
    Vec3 rows[3];
    for (Vec3& row : rows) row = random.in_cube(1.0f);
    const Vec3 stretch = {some_size(random, 3), some_size(random, 3), some_size(random, 12)};  // thin along one
    for (Vec3& p : mesh.positions) {
        const Vec3 s = {p.x * stretch.x, p.y * stretch.y, p.z * stretch.z};
        const auto along = [&](const Vec3& row) { return row.x * s.x + row.y * s.y + row.z * s.z; };
        p = {along(rows[0]), along(rows[1]), along(rows[2])};
    }
}

/// Each edge in two, at points beside their middles; triangles in four. Corners are shared by index.
void split_edges(Mesh& mesh, Random& random) {
    std::vector<std::pair<TriangleVertices, std::uint32_t>> middles;  // the ends, the lower first, and the vertex
    const auto middle = [&](std::uint32_t from, std::uint32_t to) {
        if (from > to) std::swap(from, to);
        for (const auto& [ends, vertex] : middles)
            if (ends[0] == from && ends[1] == to) return vertex;
        const Vec3 &a = mesh.positions[from], &b = mesh.positions[to];
        const float share = 0.25f + 0.5f * random.unit();
        const Vec3 off = random.in_cube(some_size(random, 16) * 0.1f);
        const auto vertex = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(sum(sum(a, times(difference(b, a), share)), off));
        middles.push_back({{from, to, 0}, vertex});
        return vertex;
    };
    const std::vector<TriangleVertices> triangles = std::exchange(mesh.triangles, {});
    for (const auto& [a, b, c] : triangles) {
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        mesh.triangles.insert(mesh.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
}

/// The triangle at `index` becomes three around a corner of its own, and its edge from corner 0 to 1 gets a sliver:
/// the corner lies `off` away from the point at `share` of the edge. The mesh stays closed.
void add_sliver(Mesh& mesh, std::size_t index, float share, Vec3 off) {
    const auto [a, b, c] = mesh.triangles[index];
    const Vec3 &from = mesh.positions[a], &to = mesh.positions[b];
    const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(sum(sum(from, times(difference(to, from), share)), off));
    mesh.triangles[index] = {a, middle, c};
    mesh.triangles.push_back({middle, b, c});
    mesh.triangles.push_back({a, b, middle});
}

/// Closed by construction: each edge runs as often one way as the other. Up to some hundred triangles, of which many
/// are slivers; no corner of one is nearer to another than float32 keeps apart, and none is without area.
Mesh make_watertight(Random& random) {
    Mesh mesh = some_base(random);
    if (random.below(3) == 0) mesh = joined(mesh, some_base(random));  // shells that cross each other
    if (random.below(4) == 0) mesh = turned_inside_out(mesh);
    if (random.coin() && mesh.triangles.size() < 100) split_edges(mesh, random);
    const std::uint32_t slivers = random.below(40);
    for (std::uint32_t i = 0; i < slivers; ++i) {
        const std::uint32_t index = random.below(static_cast<std::uint32_t>(mesh.triangles.size()));
        add_sliver(mesh, index, 0.1f + 0.8f * random.unit(), random.in_cube(some_size(random, 18) * 0.1f));
    }
    if (random.below(4) == 0)
        mesh = joined(mesh, turned_inside_out(scaled_by(mesh, 1.0f - some_size(random, 12) * 0.5f)));
    transform(mesh, random);
    mesh.name = "watertight";
    return mesh;
}

void require_sound(const Mesh& mesh, const BakeOptions& options, std::uint64_t points, Random& random,
                   ClosedTally& tally) {
    const std::string complaint = check_closed(mesh, options, points, random, tally);
    CAPTURE(mesh.name);
    CAPTURE(options.resolution.value());
    REQUIRE_MESSAGE(complaint.empty(), complaint);
}

/// A triangle that has no area, and has one when its corners move.
Mesh make_mended_cube() {
    Mesh mesh = make_cube(0.0f, 1.0f);
    mesh.name = "mended cube";
    for (Vec3& p : mesh.positions) p = {p.x + 2.0f * p.y, 3.0f * p.y - p.x, p.z};  // no axis along an edge
    // The corner lies exactly on the edge: a half has a float of its own.
    add_sliver(mesh, 0, 0.375f, {0.0f, 0.0f, 0.0f});
    return mesh;
}

/// A triangle twice, and around it the same hole twice: every edge runs as often one way as the other.
Mesh make_needed_twice() {
    Mesh mesh = make_cube(0.0f, 1.0f);
    const auto [a, b, c] = mesh.triangles[0];
    mesh.positions.push_back({0.25f, 0.5f, 3.0f});
    mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {b, a, 8}, {c, b, 8}, {a, c, 8}});
    return mesh;
}

TEST_CASE("closed: a sliver that collapses to a line leaves a closed surface with an inside") {
    const Mesh mesh = make_sliver_pyramid();
    const auto baked = must_bake_mesh(mesh, with_bits(16));
    CHECK(baked.report.findings.collapsed.count == 1);
    CHECK(baked.report.closed);
    CHECK(!baked.report.warns_of(BakeWarning::Kind::lost_closed));
    const OpenedBlob opened(baked.bytes);
    CHECK(contains(opened.blob, {0.1f, 0.1f, 0.1f}).yes());
    CHECK(contains(opened.blob, {0.5f, 0.5f, 0.5f}).no());
    const ClosestPoint nearest = signed_distance(opened.blob, {0.125f, 0.125f, 0.25f}, 10.0f);
    CHECK(nearest.distance == -0.125f);
    ClosedTally tally;
    Random random(2400);
    for (const unsigned bits : {1u, 8u, 10u, 12u, 16u, 20u, 24u})
        require_sound(mesh, with_bits(bits), scaled(200), random, tally);
}

TEST_CASE("closed: watertight meshes with slivers stay closed and contains is exact") {
    ClosedTally tally;
    Random random(2410);
    for (std::uint64_t i = 0; i < scaled(40); ++i) {
        const Mesh mesh = make_watertight(random);
        for (const unsigned bits : {8u, 10u, 12u, 16u}) {
            BakeOptions options = with_profile(every_profile[(i + bits) % every_profile.size()]);
            options.resolution = Resolution::bits(bits);
            require_sound(mesh, options, 40, random, tally);
        }
    }
    MESSAGE(tally.text());
    if (!asks_enough()) return;
    CHECK(tally.edges_not_in_pairs > tally.closed / 8);
    CHECK(tally.inside > tally.points / 20);
    CHECK(tally.other_windings > 0);
    CHECK(tally.on_surface > tally.points / 20);
}

TEST_CASE("closed: a hole of one lattice step is found wherever it is") {
    Random random(2420);
    ClosedTally tally;
    for (std::uint64_t i = 0; i < scaled(20); ++i) {
        Mesh mesh = make_watertight(random);
        const std::size_t hole = random.below(static_cast<std::uint32_t>(mesh.triangles.size()));
        if (random.coin()) mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(hole));
        else std::swap(mesh.triangles[hole][0], mesh.triangles[hole][1]);
        for (const unsigned bits : {8u, 12u, 16u}) require_sound(mesh, with_bits(bits), 4, random, tally);
    }
    CHECK(tally.closed < tally.bakes);  // what collapses leaves no hole
}

TEST_CASE("closed: long edges cancel with short ones on the same line and with no others") {
    // Two flat quadrilaterals, back to back. The edge of one is in two parts, of the other in three.
    const auto folded = [](float third) {
        return Mesh{.positions = {{0, 0, 0}, {6, 0, 0}, {6, 4, 0}, {0, 4, 0}, {2, 0, 0}, {third, 0, 0}, {3, 0, 0}},
                    .triangles = {{0, 6, 3}, {6, 1, 2}, {6, 2, 3}, {4, 0, 3}, {5, 4, 3}, {1, 5, 2}, {2, 5, 3}}};
    };
    CHECK(bake_mesh(folded(4.0f)).report.closed);
    CHECK(bake_mesh(folded(5.0f)).report.closed);
    Mesh bent = folded(4.0f);
    bent.positions[5].z = 1.0f;
    CHECK(!bake_mesh(bent).report.closed);
    Mesh beside = folded(4.0f);
    beside.positions[6].y = 1.0f;
    CHECK(!bake_mesh(beside).report.closed);
}

TEST_CASE("closed: edges cancel along lines of every direction") {
    const Vec3 directions[] = {{1, 0, 0},  {0, 1, 0}, {0, 0, 1},  {0, 1, 1},  {0, 1, -1}, {1, 0, -1},
                               {1, -1, 0}, {1, 2, 3}, {-2, 3, 4}, {0, -2, 3}, {0, 0, -1}, {-1, 0, 0}};
    for (const Vec3& along : directions) {
        const Vec3 up = along.x != 0.0f ? Vec3{0, 1, 2} : Vec3{1, 0, 0};
        const auto place = [&](float x, float y) {
            return Vec3{x * along.x + y * up.x, x * along.y + y * up.y, x * along.z + y * up.z};
        };
        Mesh mesh = {.positions = {place(0, 0), place(6, 0), place(6, 4), place(0, 4), place(2, 0), place(3, 0)},
                     .triangles = {{0, 5, 3}, {5, 1, 2}, {5, 2, 3}, {4, 0, 3}, {1, 4, 2}, {2, 4, 3}}};
        CHECK(bake_mesh(mesh).report.closed);
        mesh.positions[5] = place(3, 1);
        CHECK(!bake_mesh(mesh).report.closed);
    }
}

TEST_CASE("closed: corners of the source are one vertex exactly where their positions are equal") {
    Random random(2430);
    const auto is_closed = [](const Mesh& mesh) {
        baker::Source source;
        for (const Vec3& position : mesh.positions) source.positions.push_back(baker::to_float64(position));
        for (const TriangleVertices& corners : mesh.triangles)
            source.triangles.push_back({{corners[0], corners[1], corners[2]}, 0});
        const bool result = baker::is_closed(source);
        source.without_area = {{{1, 1, 2}, 0}};  // there and back, and an edge from a vertex to itself
        REQUIRE(baker::is_closed(source) == result);
        return result;
    };
    REQUIRE(!baker::is_closed(baker::Source()));
    for (int i = 0; i < 300; ++i) {
        Mesh mesh;
        mesh.positions = {{0.0f, random.signed_unit(), random.signed_unit()},
                          {random.signed_unit(), 0.0f, random.signed_unit()},
                          {random.signed_unit(), random.signed_unit(), 0.0f},
                          random.in_cube(1.0f)};
        mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
        REQUIRE(is_closed(mesh));
        for (std::uint32_t k = 0; k < 3; ++k) {
            Mesh apart = mesh;
            apart.positions.push_back(mesh.positions[k]);
            apart.triangles[0][static_cast<std::size_t>(std::ranges::find(mesh.triangles[0], k) -
                                                        mesh.triangles[0].begin())] = 4;
            Vec3& corner = apart.positions[4];
            float* const coordinates[3] = {&corner.x, &corner.y, &corner.z};
            REQUIRE(is_closed(apart));
            *coordinates[k] = -0.0f;
            REQUIRE(is_closed(apart));
            float& moved = *coordinates[random.below(3)];
            moved = std::nextafter(moved, 2.0f);
            REQUIRE(!is_closed(apart));
        }
    }
}

TEST_CASE("closed: a triangle without area in the source that gets one by rounding is a loss with bits that keep") {
    const Mesh mesh = make_mended_cube();
    bool was_lost = false;
    for (unsigned bits = 2; bits <= 20; ++bits) {
        const auto baked = must_bake_mesh(mesh, with_bits(bits));
        const BakeReport& report = baked.report;
        CHECK(report.findings.zero_area.count == 1);
        CHECK(report.warns_of(BakeWarning::Kind::lost_closed) == !report.closed);
        was_lost = was_lost || report.warns_of(BakeWarning::Kind::lost_closed);
        if (!report.warns_of(BakeWarning::Kind::lost_closed)) continue;
        REQUIRE(report.bits_that_keep_closed > bits);
        for (unsigned more = bits + 1; more <= report.bits_that_keep_closed; ++more)
            CHECK(bake_mesh(mesh, with_bits(more)).report.closed == (more == report.bits_that_keep_closed));
    }
    CHECK(was_lost);
}

TEST_CASE("closed: duplicates that are dropped may lose it and no bits keep what is in the source") {
    const auto baked = must_bake_mesh(make_needed_twice());
    CHECK(baked.report.findings.duplicate.count == 1);
    CHECK(!baked.report.closed);
    CHECK(baked.report.warns_of(BakeWarning::Kind::lost_closed));
    CHECK(baked.report.bits_that_keep_closed == 0);
    const auto twice = bake_mesh(joined(make_cube(0.0f, 1.0f), make_cube(0.0f, 1.0f)));
    CHECK(twice.report.findings.duplicate.count == 12);
    CHECK(twice.report.closed);
}

TEST_CASE("closed: a closed source that collapses as a whole is lost and the report names the bits that keep it") {
    const auto needle = [](float width) {
        return Mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, width, 0}, {0, 0, width}},
                    .triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
    };
    const auto thin = must_bake_mesh(needle(1e-7f));
    CHECK(thin.report.tree.triangles == 0);
    CHECK(thin.report.warns_of(BakeWarning::Kind::lost_closed));
    const unsigned keeping = thin.report.bits_that_keep_closed;
    REQUIRE(keeping > thin.report.lattice.bits);
    for (unsigned bits = thin.report.lattice.bits + 1; bits <= keeping; ++bits)
        CHECK(bake_mesh(needle(1e-7f), with_bits(bits)).report.closed == (bits == keeping));
    const auto too_thin = bake_mesh(needle(1e-9f));
    CHECK(too_thin.report.warns_of(BakeWarning::Kind::lost_closed));
    CHECK(too_thin.report.bits_that_keep_closed == 0);
}

TEST_CASE("closed: triangles without area alone lose nothing") {
    Mesh mesh = {.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, .triangles = {{0, 1, 2}, {2, 1, 0}}};
    const auto baked = must_bake_mesh(mesh);
    CHECK(baked.report.findings.zero_area.count == 2);
    CHECK(!baked.report.closed);
    CHECK(!baked.report.warns_of(BakeWarning::Kind::lost_closed));
}

TEST_CASE("closed: a trial bakes the same blob and leaves out what became of a closed source") {
    const Mesh mesh = make_needed_twice();
    const MeshView view = mesh.view();
    const auto trial = baker::bake_trial({&view, 1}, {});
    const auto baked = bake_mesh(mesh);
    REQUIRE(trial);
    CHECK(trial.bytes == baked.bytes);
    CHECK(baked.report.warns_of(BakeWarning::Kind::lost_closed));
    CHECK(!trial.report.warns_of(BakeWarning::Kind::lost_closed));
}

TEST_CASE("closed: a tube with open ends is open although its areas cancel") {
    Mesh mesh = make_cube(0.0f, 1.0f);
    std::erase_if(mesh.triangles, [&](const TriangleVertices& corners) {
        const auto height = [&](std::size_t k) { return mesh.positions[corners[k]].z; };
        return height(0) == height(1) && height(1) == height(2);
    });
    REQUIRE(mesh.triangles.size() == 8);
    CHECK(!bake_mesh(mesh).report.closed);
}

TEST_CASE("closed: what is open in the source is not lost") {
    Mesh mesh = make_terrain(5, 1);
    mesh.triangles.push_back(mesh.triangles[3]);
    const auto baked = bake_mesh(mesh);
    CHECK(baked.report.findings.duplicate.count == 1);
    CHECK(!baked.report.closed);
    CHECK(!baked.report.warns_of(BakeWarning::Kind::lost_closed));
    CHECK(bake({}, {}).report.warns_of(BakeWarning::Kind::lost_closed) == false);
}

TEST_CASE("closed: from 23 bits on the report warns that rays are rounded coarsely") {
    const Mesh mesh = make_icosphere(1, 1.0, {0.0f, 0.0f, 0.0f});
    for (unsigned bits = 20; bits <= 24; ++bits)
        CHECK(bake_mesh(mesh, with_bits(bits)).report.warns_of(BakeWarning::Kind::rays_rounded_coarsely) ==
              (bits >= 23));
}

}  // namespace
}  // namespace espalier::tests::closed_test
