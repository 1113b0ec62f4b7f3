// The baker's table of contents: one call for each stage, in order.
#include <espalier/bake.hpp>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include <espalier/blob.hpp>
#include <espalier/deformation.hpp>
#include <espalier/advanced/lattice.hpp>

#include <baker/bake_with.hpp>
#include <baker/base/float_rounding.hpp>
#include <baker/build/build.hpp>
#include <baker/collapse/collapse.hpp>
#include <baker/collapse/leaf_size.hpp>
#include <baker/collapse/order.hpp>
#include <baker/collapse/strip.hpp>
#include <baker/deformation/motion.hpp>
#include <baker/deformation/steered_tree.hpp>
#include <baker/encode/encode.hpp>
#include <baker/encode/remap.hpp>
#include <baker/error/fit_lattice.hpp>
#include <baker/input/check_input.hpp>
#include <baker/optimise/reinsertion.hpp>
#include <baker/policy.hpp>
#include <baker/progress.hpp>
#include <baker/quantise/closed.hpp>
#include <baker/quantise/lattice.hpp>
#include <baker/sections/optional_sections.hpp>
#include <baker/verify/check_result.hpp>
#include <baker/warnings.hpp>

namespace espalier {

namespace baker {

namespace {

float to_world(float origin, std::int32_t coordinate, double step) {
    return static_cast<float>(double(origin) + coordinate * step);
}

void fill_in(BakeReport& report, const LatticeMesh& mesh, const WideTree& wide, const Properties& properties,
             const OptionalSections& sections, std::size_t bytes) {
    const Lattice& lattice = mesh.lattice;
    const double step = lattice.step();
    report.bounds.min = lattice.origin;
    report.bounds.max = {to_world(lattice.origin.x, mesh.extent.x, step),
                         to_world(lattice.origin.y, mesh.extent.y, step),
                         to_world(lattice.origin.z, mesh.extent.z, step)};
    report.bounds.extent = std::max({mesh.extent.x, mesh.extent.y, mesh.extent.z}) * step;
    report.bounds.volumes = volumes_of(sections, mesh);
    report.lattice = {lattice.bits, step, double(properties.max_error)};
    report.tree = {.triangles = static_cast<std::uint32_t>(mesh.triangles.size()),
                   .duplicate_references = wide.copies,
                   .vertices = mesh.used_vertices,
                   .nodes = static_cast<std::uint32_t>(wide.nodes.size()),
                   .leaves = wide.leaves.size(),
                   .depth = wide.depth};
    report.closed = properties.closed;
    report.bytes = bytes;
}

/// Returns the lattice points of all poses; none of a blob that does not deform.
std::vector<std::vector<LatticePoint>> place_poses(const BakeOptions& options, const Lattice& lattice) {
    std::vector<std::vector<LatticePoint>> poses;
    if (!options.deformation) return poses;
    for (const std::vector<Vec3>& pose : options.deformation->poses) {
        poses.emplace_back();
        for (const Vec3& position : pose) poses.back().push_back(place(to_float64(position), lattice));
    }
    return poses;
}

/// Replaces the range by the box of the meshes' own positions, and reports the range apart.
void fill_in_motion(BakeReport& report, const LatticeMesh& mesh, std::span<const std::byte> bytes) {
    const Blob blob = open_unchecked(bytes);
    report.motion = {{report.bounds.min, report.bounds.max},
                     static_cast<std::uint32_t>(mesh.vertices.size()),
                     deformable_bytes(blob)};
    const Box box = blob.bounds();
    report.bounds.min = box.min;
    report.bounds.max = box.max;
    report.bounds.extent = std::max({double(box.max.x) - double(box.min.x), double(box.max.y) - double(box.min.y),
                                     double(box.max.z) - double(box.min.z)});
}

BakeResult refused(const Refusal& refusal) {
    BakeResult result;
    result.status = refusal.status;
    result.message = refusal.message;
    result.place = refusal.place;
    return result;
}

Refusal internal_error(const std::string& complaint) {
    return {BakeStatus::internal, "the baker's check of its own result failed: " + complaint +
                                      ". Nothing was baked. Please report this with the input mesh"};
}

BakeResult bake_in_stages(const TreeMaker& make_tree, std::span<const MeshView> meshes, const BakeOptions& options,
                          const RayCosts& costs, LostClosed lost_closed) {
    const auto start = std::chrono::steady_clock::now();
    const Progress progress(options.progress);
    BakeResult result;
    BakeReport& report = result.report;
    if (const auto refusal = check_options(options)) return refused(*refusal);

    progress.begin(stages::check);
    const auto source = check_input(meshes, choose_origin(meshes, options), options, report);
    if (!source) return refused(source.refusal());

    progress.begin(stages::snap);
    const SourceBounds bounds = options.deformation ? range_of(*source, *options.deformation) : bounds_of(*source);
    const auto fitted = options.deformation ? fit_range(*source, bounds, options.resolution, report.findings)
                                            : fit_lattice(*source, bounds, options.resolution, report.findings);
    if (!fitted) return refused(fitted.refusal());
    const LatticeMesh& mesh = fitted->mesh;
    const Properties properties{fitted->error.largest,
                                options.deformation ? edges_cancel_in_pairs(mesh) : is_closed(mesh)};

    progress.begin(stages::build);
    BuildSettings settings = build_settings(options.effort, options.threads);
    settings.duplicate_budget = options.build.duplicate_budget;
    settings.full_leaf = full_leaf(options.profile, options.build.max_leaf_triangles);
    settings.progress = progress.within(stages::build);
    const BinaryTree tree = make_steered_tree(make_tree, mesh, place_poses(options, mesh.lattice), settings);

    progress.begin(stages::collapse);
    std::optional<StripMaker> strips;
    if (options.profile != Profile::fast) strips.emplace(mesh, tree, options.profile);
    const StripMaker* const strips_if_any = strips ? &*strips : nullptr;
    const auto sizes = leaf_sizes(options.profile, mesh.lattice.bits, strips_if_any, !mesh.is_deformable);
    const CollapsePlan plan(mesh, tree, *sizes,
                            {options.profile, costs, options.build.byte_price, options.build.max_leaf_triangles});

    progress.begin(stages::order);
    const WideTree wide = put_in_order(mesh, tree, plan, strips_if_any);

    progress.begin(stages::encode);
    const OptionalSections sections = make_optional_sections(mesh, options);
    auto blob = encode(*source, mesh, tree, wide, options, properties, sections);
    if (!blob) return refused(blob.refusal());

    progress.begin(stages::verify);
    if (const auto complaint = check_result(*blob, mesh, tree, wide)) return refused(internal_error(*complaint));
    progress.finish();

    result.bytes = std::move(*blob);
    result.remap = remap_of(*source, mesh, wide);
    fill_in(report, mesh, wide, properties, sections, result.bytes.size());
    if (options.deformation) fill_in_motion(report, mesh, result.bytes);
    add_warnings(*source, bounds, mesh.lattice, options.deformation ? LostClosed::left_out : lost_closed, report);
    if (options.policy)
        if (const auto refusal = judge(*options.policy, report)) return refused(*refusal);
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result.status = BakeStatus::ok;
    return result;
}

/// Bakes with the tree that the options choose.
BakeResult bake_as_chosen(std::span<const MeshView> meshes, const BakeOptions& options, LostClosed lost_closed) {
    const auto make_tree = [&](const LatticeMesh& mesh, const BuildSettings& settings) {
        return optimise(build(mesh, options.build.builder, settings), optimise_settings(options.effort));
    };
    return bake_in_stages(make_tree, meshes, options, {}, lost_closed);
}

}  // namespace

BakeResult bake_with(const TreeMaker& make_tree, std::span<const MeshView> meshes, const BakeOptions& options,
                     const RayCosts& costs) {
    return bake_in_stages(make_tree, meshes, options, costs, LostClosed::tested);
}

BakeResult bake_trial(std::span<const MeshView> meshes, const BakeOptions& options) {
    return bake_as_chosen(meshes, options, LostClosed::left_out);
}

}  // namespace baker

Resolution Resolution::same_as(const Lattice& lattice) noexcept { return step(lattice.step_exponent); }

BakeResult bake(std::span<const MeshView> meshes, const BakeOptions& options) {
    return baker::bake_as_chosen(meshes, options, baker::LostClosed::tested);
}

}  // namespace espalier
