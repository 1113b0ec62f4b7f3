// The baker's table of contents: one call for each stage, in order.
#include <espalier/bake.hpp>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include <espalier/lattice.hpp>

#include <baker/bake_with.hpp>
#include <baker/build/build.hpp>
#include <baker/collapse/collapse.hpp>
#include <baker/collapse/leaf_size.hpp>
#include <baker/collapse/order.hpp>
#include <baker/collapse/strip.hpp>
#include <baker/encode/encode.hpp>
#include <baker/encode/remap.hpp>
#include <baker/error/fit_lattice.hpp>
#include <baker/input/check_input.hpp>
#include <baker/optimise/reinsertion.hpp>
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
    const auto source = check_input(meshes, options, report);
    if (!source) return refused(source.refusal());

    progress.begin(stages::snap);
    const SourceBounds bounds = bounds_of(*source);
    const auto fitted = fit_lattice(*source, bounds, options.resolution, report.findings);
    if (!fitted) return refused(fitted.refusal());
    const LatticeMesh& mesh = fitted->mesh;
    const Properties properties{fitted->error.largest, is_closed(mesh)};

    progress.begin(stages::build);
    BuildSettings settings = build_settings(options.effort, options.threads);
    settings.duplicate_budget = options.build.duplicate_budget;
    settings.full_leaf = full_leaf(options.profile, options.build.max_leaf_triangles);
    settings.progress = progress.within(stages::build);
    const BinaryTree tree = make_tree(mesh, settings);

    progress.begin(stages::collapse);
    std::optional<StripMaker> strips;
    if (options.profile != Profile::fast) strips.emplace(mesh, tree, options.profile);
    const StripMaker* const strips_if_any = strips ? &*strips : nullptr;
    const auto sizes = leaf_sizes(options.profile, mesh.lattice.bits, strips_if_any);
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
    add_warnings(*source, bounds, mesh.lattice, lost_closed, report);
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
