#include <baker/sections/optional_sections.hpp>

#include <algorithm>

#include <espalier/contact.hpp>
#include <espalier/format.hpp>
#include <runtime/blob/duplicate_references.hpp>
#include <runtime/blob/stored_bounds.hpp>

#include <baker/base/byte_writer.hpp>
#include <baker/sections/edge_flags.hpp>

namespace espalier::baker {

namespace {

constexpr const char* edge_names[3] = {"a to b", "b to c", "c to a"};
constexpr const char* kind_names[4] = {"flat", "convex", "concave", "boundary"};

void put_edge_flags(std::vector<std::byte>& blob, const OptionalSections& sections, const WideTree& wide) {
    put_u32(blob, sections.flat_limit);
    BitStream stream(blob);
    for (std::size_t i = 0; i < wide.triangles.size(); ++i) {
        const auto& flags = sections.edge_flags[wide.triangles[i]].kinds;
        for (unsigned edge = 0; edge < 3; ++edge)
            stream.put(flags[(wide.first_corners[i] + edge) % 3u], format::edge_flags::edge_bits);
    }
    stream.finish();
    pad_to(blob, 4);
}

template <class Numbers>
void put_all(std::vector<std::byte>& blob, const Numbers& numbers) {
    for (const auto number : numbers) put_u32(blob, static_cast<std::uint32_t>(number));
}

std::optional<std::string> check_edge_flags(const Blob& blob, const LatticeMesh& mesh) {
    const detail::BlobData& data = espalier::detail::data_of(blob);
    const auto expected = edge_flags_of(mesh, detail::load_u32(data.edge_flags + format::edge_flags::flat_limit_at));
    std::vector<std::uint32_t> number_of(data.triangle_count);  // in the mesh, of each storage index that is no copy
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) number_of[mesh.triangles[i].original_id] = i;
    for (std::uint32_t index = 0; index < data.triangle_count; ++index) {
        const auto& flags = expected[number_of[detail::owner_of(data, index)]];
        const EdgeKinds found = *edge_kinds(blob, TriangleId{index});
        const EdgeKind kinds[3] = {found.ab, found.bc, found.ca};
        for (std::size_t edge = 0; edge < 3; ++edge) {
            const auto kind = static_cast<std::uint8_t>(kinds[edge]);
            if (kind == flags.kinds[edge] || flags.is_alone[edge]) continue;  // perhaps joined to another blob
            return "triangle " + std::to_string(index) + " calls its edge " + edge_names[edge] + ' ' +
                   kind_names[kind] + ", but it is " + kind_names[flags.kinds[edge]];
        }
    }
    return std::nullopt;
}

std::string sticks_out(const LatticePoint& point, const char* of) {
    return "the vertex at " + std::to_string(point.x) + ' ' + std::to_string(point.y) + ' ' + std::to_string(point.z) +
           " lies outside of the " + of;
}

std::optional<std::string> check_bounds(const detail::BlobData& data, const std::vector<LatticePoint>& points) {
    using namespace format::bounds;
    if (const std::byte* box = detail::stored_bounds(data, format::feature::oriented_box); box != nullptr) {
        const detail::IntegerRotation rotation = detail::stored_rotation(box);
        for (const LatticePoint& p : points) {
            for (std::size_t k = 0; k < 3; ++k) {
                const auto& row = rotation.row[k];
                const std::int64_t at = units_per_step * (std::int64_t{row[0]} * p.x + std::int64_t{row[1]} * p.y +
                                                          std::int64_t{row[2]} * p.z);
                const std::int64_t lo = std::int64_t{rotation.norm} * detail::load_i32(box + lo_at + 4 * k);
                const std::int64_t hi = std::int64_t{rotation.norm} * detail::load_i32(box + hi_at + 4 * k);
                if (at < lo || at > hi) return sticks_out(p, "oriented box");
            }
        }
    }
    if (const std::byte* sphere = detail::stored_bounds(data, format::feature::bounding_sphere); sphere != nullptr) {
        const std::int64_t radius = detail::load_u32(sphere + radius_at);
        for (const LatticePoint& p : points) {
            std::int64_t squared = 0;
            const std::int32_t coordinates[3] = {p.x, p.y, p.z};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::int64_t side =
                    std::int64_t{units_per_step} * coordinates[k] - detail::load_i32(sphere + center_at + 4 * k);
                squared += side * side;
            }
            if (squared > radius * radius) return sticks_out(p, "sphere");
        }
    }
    if (const std::byte* stored = detail::stored_bounds(data, format::feature::k_dop); stored != nullptr) {
        const FittedKDop k_dop = fit_k_dop(points);
        for (std::size_t k = 0; k < k_dop_directions; ++k) {
            if (detail::load_i32(stored + 8 * k) == k_dop.lo[k] && detail::load_i32(stored + 8 * k + 4) == k_dop.hi[k])
                continue;
            return "the vertices lie between " + std::to_string(k_dop.lo[k]) + " and " + std::to_string(k_dop.hi[k]) +
                   " along direction " + std::to_string(k) + " of the 26-DOP, whose slab is another";
        }
    }
    return std::nullopt;
}

}  // namespace

OptionalSections make_optional_sections(const LatticeMesh& mesh, const BakeOptions& options) {
    namespace feature = format::feature;
    OptionalSections sections;
    if (mesh.triangles.empty()) return sections;
    if (options.flat_angle) {
        sections.features |= feature::edge_flags;
        sections.flat_limit = flat_limit_of(*options.flat_angle);
        sections.edge_flags = edge_flags_of(mesh, sections.flat_limit);
    }
    if (options.bounds.oriented_box) sections.features |= feature::oriented_box;
    if (options.bounds.sphere) sections.features |= feature::bounding_sphere;
    if (options.bounds.k_dop) sections.features |= feature::k_dop;
    if ((sections.features & feature::bounds) == 0) return sections;

    std::vector<LatticePoint> points;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
        if (mesh.is_used[i] != 0) points.push_back(mesh.vertices[i]);
    const std::vector<LatticePoint> outermost = outermost_points(points);
    if (options.bounds.oriented_box) sections.box = fit_box(points, outermost);
    if (options.bounds.sphere) sections.sphere = fit_sphere(points, outermost);
    if (options.bounds.k_dop) sections.k_dop = fit_k_dop(points);
    return sections;
}

void put_optional_sections(std::vector<std::byte>& blob, const OptionalSections& sections, const WideTree& wide) {
    namespace feature = format::feature;
    if ((sections.features & feature::edge_flags) != 0) put_edge_flags(blob, sections, wide);
    if ((sections.features & feature::oriented_box) != 0) {
        for (const std::int32_t part : sections.box.quaternion)
            put_u16(blob, static_cast<std::uint32_t>(part) & 0xFFFF);
        put_all(blob, sections.box.lo);
        put_all(blob, sections.box.hi);
    }
    if ((sections.features & feature::bounding_sphere) != 0) {
        put_all(blob, sections.sphere.center);
        put_u32(blob, sections.sphere.radius);
    }
    if ((sections.features & feature::k_dop) != 0) {
        for (std::size_t k = 0; k < format::bounds::k_dop_directions; ++k) {
            put_u32(blob, static_cast<std::uint32_t>(sections.k_dop.lo[k]));
            put_u32(blob, static_cast<std::uint32_t>(sections.k_dop.hi[k]));
        }
    }
}

BoundsVolumes volumes_of(const OptionalSections& sections, const LatticeMesh& mesh) {
    namespace feature = format::feature;
    BoundsVolumes volumes;
    if ((sections.features & feature::bounds) == 0) return volumes;
    const double step = mesh.lattice.step();
    const double unit = step * step * step;
    volumes.box = unit * mesh.extent.x * mesh.extent.y * mesh.extent.z;
    if ((sections.features & feature::oriented_box) != 0) volumes.oriented_box = unit * volume_of(sections.box);
    if ((sections.features & feature::bounding_sphere) != 0) volumes.sphere = unit * volume_of(sections.sphere);
    if ((sections.features & feature::k_dop) != 0) volumes.k_dop = unit * volume_of(sections.k_dop, mesh.extent);
    return volumes;
}

std::optional<std::string> check_optional_sections(const Blob& blob, const LatticeMesh& mesh) {
    if (blob.has_edge_flags())
        if (auto complaint = check_edge_flags(blob, mesh)) return complaint;
    return check_bounds(espalier::detail::data_of(blob), mesh.vertices);
}

}  // namespace espalier::baker
