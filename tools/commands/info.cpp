// info: what is inside a blob or a scene.
#include <cmath>
#include <iomanip>
#include <iostream>
#include <optional>
#include <utility>
#include <vector>

#include <espalier/espalier.hpp>

#include <import/base/numbers.hpp>
#include <runtime/blob/deformable_blob.hpp>

#include "commands.hpp"
#include "files/blob_file.hpp"
#include "layout/places.hpp"
#include "layout/tree_quality.hpp"
#include "report/diagnostics.hpp"
#include "report/json.hpp"
#include "report/source_point.hpp"

namespace espalier::tools {

namespace {

/// Copies left out.
std::uint32_t triangles_of(const Blob& blob) { return blob.triangle_count() - blob.duplicate_reference_count(); }

double bytes_per_triangle(std::size_t bytes, const Blob& blob) {
    return blob.triangle_count() == 0 ? 0.0 : static_cast<double>(bytes) / triangles_of(blob);
}

/// The largest side of the bounds.
double extent_of(const Blob& blob) {
    const detail::PoseBounds bounds = detail::pose_bounds_of(detail::data_of(blob));
    std::int32_t largest = 0;
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, bounds.high[axis] - bounds.low[axis]);
    return std::ldexp(1.0, blob.lattice().step_exponent) * largest;
}

std::string blob_format_version(const AssetFile& file) {
    return text(read_u16(file.bytes, format::header::version_major_at), '.',
                read_u16(file.bytes, format::header::version_minor_at));
}

void print_blob_json(const InfoArguments& arguments, const AssetFile& file) {
    const Blob& blob = file.blob;
    Json document = json_document();
    document["file"] = arguments.blob;
    document["format_version"] = blob_format_version(file);
    document["profile"] = name_of(blob.profile());
    document["triangles"] = triangles_of(blob);
    document["copies"] = blob.duplicate_reference_count();
    document["vertices"] = blob.vertex_count();
    document["bytes"] = blob.size();
    document["bytes_per_triangle"] = bytes_per_triangle(blob.size(), blob);
    Json sections = Json::object();
    for (const Section& section : sections_of(blob)) sections[section.name] = section.bytes;
    document["sections"] = std::move(sections);
    document["bits"] = detail::data_of(blob).bits;
    document["step"] = json_number(std::ldexp(1.0f, blob.lattice().step_exponent));
    document["extent"] = extent_of(blob);
    document["max_error"] = json_number(blob.max_error());
    if (blob.source_origin() != Vec3d{}) document["source_origin"] = json_point(blob.source_origin());
    document["bounds"] = json_box(blob.bounds().min, blob.bounds().max);
    if (const Result<Sphere> sphere = bounding_sphere(blob)) {
        document["sphere"] = {{"center", json_point(sphere->center)}, {"radius", json_number(sphere->radius)}};
    }
    if (const Result<OrientedBox> box = oriented_bounds(blob)) {
        Json half_axes = Json::array();
        for (const Vec3& axis : box->half_axes) half_axes.push_back(json_point(axis));
        document["oriented_box"] = {{"center", json_point(box->center)}, {"half_axes", std::move(half_axes)}};
    }
    if (const Result<KDop> k_dop = k_dop_bounds(blob)) {
        Json slabs = Json::array();
        for (unsigned k = 0; k < KDop::count; ++k) {
            slabs.push_back({{"direction", json_point(KDop::directions[k])},
                             {"min", json_number(k_dop->lo[k])},
                             {"max", json_number(k_dop->hi[k])}});
        }
        document["k_dop"] = std::move(slabs);
    }
    document["depth"] = blob.depth();
    document["nodes"] = detail::data_of(blob).node_count;
    document["leaves"] = leaf_count(file.bytes, blob);
    document["features"] = feature_names(detail::data_of(blob).features);
    document["closed"] = blob.is_closed();
    if (const std::optional<double> angle = flat_angle_of(blob)) document["flat_angle"] = *angle;
    document["deformable"] = blob.is_deformable();
    if (blob.is_deformable()) document["motion"] = motion_json(blob);
    document["sources"] = detail::data_of(blob).source_count;
    document["source_triangles"] = detail::data_of(blob).source_triangles;
    document["checksum"] = checksum_text(blob.checksum());
    if (arguments.histogram) document["tree_quality"] = tree_quality_json(tree_quality_of(blob));
    print_json(document);
}

void print_motion(const Blob& blob) {
    const Motion motion = motion_of(blob);
    print_line("range", shortest(motion.range.min), " to ", shortest(motion.range.max));
    print_line("positions", motion.positions);
    print_line("moving bytes", motion.moving_bytes, ", ", rounded(bytes_per_triangle(motion.moving_bytes, blob), 4),
               " per triangle; the rest may stay in flash");
}

void print_blob_table(const InfoArguments& arguments, const AssetFile& file) {
    const Blob& blob = file.blob;
    std::cout << printable(arguments.blob) << '\n';
    print_line("format", blob_format_version(file), ", profile ", name_of(blob.profile()));
    print_line("triangles", triangles_of(blob));
    if (blob.duplicate_reference_count() != 0)
        print_line("copies", blob.duplicate_reference_count(), ", in further leaves: answers rays, enumerates nothing");
    print_line("vertices", blob.vertex_count());
    if (blob.source_origin() != Vec3d{}) {
        print_line("source origin", words_for_origin(blob.source_origin()),
                   " of the source is 0 0 0 of the blob, from which all coordinates here count");
    }
    print_line("bounds", shortest(blob.bounds().min), " to ", shortest(blob.bounds().max));
    if (const Result<Sphere> sphere = bounding_sphere(blob)) {
        print_line("sphere", "center ", shortest(sphere->center), ", radius ", shortest(sphere->radius));
    }
    if (const Result<OrientedBox> box = oriented_bounds(blob)) {
        print_line("oriented box", "center ", shortest(box->center));
        for (const Vec3& axis : box->half_axes) print_line("  half axis", shortest(axis));
    }
    print_line("extent", rounded(extent_of(blob)));
    if (blob.is_deformable()) print_motion(blob);
    print_line("lattice", unsigned{detail::data_of(blob).bits}, " bits, step ",
               shortest(std::ldexp(1.0f, blob.lattice().step_exponent)));
    print_line("max error", shortest(blob.max_error()));
    const std::vector<std::string> features = feature_names(detail::data_of(blob).features);
    print_line("features", features.empty() ? "none" : listed(features, ", "));
    if (const std::optional<double> angle = flat_angle_of(blob))
        print_line("flat angle", *angle, " degrees, the largest at which an edge is flat");
    if (blob.has_original_ids()) {
        print_line("sources", counted(detail::data_of(blob).source_count, "mesh"), " with ",
                   counted(detail::data_of(blob).source_triangles, "triangle"));
    }
    const std::uint64_t leaves = leaf_count(file.bytes, blob);
    print_line("tree", counted(detail::data_of(blob).node_count, "node"), ", ", counted(leaves, "leaf"), ", depth ",
               blob.depth());
    print_line("checksum", checksum_text(blob.checksum()));
    print_line("bytes", blob.size(), ", ", rounded(bytes_per_triangle(blob.size(), blob), 4),
               " per triangle, of which");
    for (const Section& section : sections_of(blob))
        print_section({section.name, section.bytes}, rounded(bytes_per_triangle(section.bytes, blob), 3));
    if (arguments.histogram) print_tree_quality(tree_quality_of(blob));
    finish_standard_output();
}

}  // namespace

void print_value(const std::string& name, const std::string& value) {
    std::cout << "  " << std::left << std::setw(14) << name << value << '\n';
}

void print_section(const NamedBytes& section, const std::string& per_triangle) {
    std::cout << "    " << std::left << std::setw(14) << section.name << std::right << std::setw(12) << section.bytes
              << std::setw(per_triangle.empty() ? 0 : 10) << per_triangle << '\n';
}

ExitCode run_info(const InfoArguments& arguments) {
    const AssetFile file(arguments.blob);
    file.require_open();
    if (file.is_a_scene) {
        print_scene_info(arguments, file);
        return ExitCode::ok;
    }
    if (arguments.json) {
        print_blob_json(arguments, file);
    } else {
        print_blob_table(arguments, file);
    }
    return ExitCode::ok;
}

}  // namespace espalier::tools
