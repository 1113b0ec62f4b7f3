// The baker's table of contents: one call for each stage, in order.
#include <espalier/bake.hpp>

#include <algorithm>
#include <chrono>
#include <optional>

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
#include <baker/quantise/lost_closed.hpp>
#include <baker/sections/optional_sections.hpp>
#include <baker/verify/check_result.hpp>

namespace espalier {

namespace baker {

namespace {

constexpr unsigned coarse_ray_bits = 23;  // from here on the asset fills the grid of rays, which is then whole steps

float to_world(float origin, std::int32_t coordinate, double step) {
    return static_cast<float>(double(origin) + coordinate * step);
}

void fill_in(BakeReport& report, const SourceBounds& bounds, const LatticeMesh& mesh, const WideTree& wide,
             const Properties& properties, std::size_t bytes) {
    const Lattice& lattice = mesh.lattice;
    const double step = lattice.step();
    report.triangles = static_cast<std::uint32_t>(mesh.triangles.size());
    report.copies = wide.copies;
    report.vertices = mesh.used_vertices;
    report.bounds_min = lattice.origin;
    report.bounds_max = {to_world(lattice.origin.x, mesh.extent.x, step),
                         to_world(lattice.origin.y, mesh.extent.y, step),
                         to_world(lattice.origin.z, mesh.extent.z, step)};
    report.step = step;
    report.extent = std::max({mesh.extent.x, mesh.extent.y, mesh.extent.z}) * step;
    report.max_error = double(properties.max_error);
    report.bits = lattice.bits;
    report.closed = properties.closed;
    report.rays_rounded_coarsely = lattice.bits >= coarse_ray_bits;
    report.step_below_float_spacing = is_below_float_spacing(lattice, bounds);
    report.depth = wide.depth;
    report.nodes = static_cast<std::uint32_t>(wide.nodes.size());
    report.leaves = wide.leaves.size();
    report.bytes = bytes;
}

BakeError internal_error(const std::string& complaint) {
    return {BakeError::Kind::internal, "the baker's check of its own result failed: " + complaint +
                                           ". Nothing was baked. Please report this with the input mesh"};
}

/// Whether the report answers if a closed source was lost.
enum class LostClosed { left_out, reported };

Result<Baked, BakeError> bake_in_stages(const TreeMaker& make_tree, std::span<const MeshView> meshes,
                                        const BakeOptions& options, LostClosed lost_closed) {
    const auto start = std::chrono::steady_clock::now();
    const Progress progress(options.progress);
    Baked baked;
    BakeReport& report = baked.report;
    if (auto error = check_options(options)) return *error;

    progress.begin(stages::check);
    const auto source = check_input(meshes, options, report);
    if (!source) return source.error();

    progress.begin(stages::snap);
    const SourceBounds bounds = bounds_of(*source);
    const auto fitted = fit_lattice(*source, bounds, options, report);
    if (!fitted) return fitted.error();
    const LatticeMesh& mesh = fitted->mesh;
    const Properties properties{fitted->error.largest, is_closed(mesh)};

    progress.begin(stages::build);
    BuildSettings settings = build_settings(options.effort, options.threads);
    settings.duplicates = options.duplicates;
    settings.full_leaf = full_leaf(options.profile, options.max_leaf_triangles);
    settings.progress = progress.within(stages::build);
    const BinaryTree tree = make_tree(mesh, settings);

    progress.begin(stages::collapse);
    std::optional<StripMaker> strips;
    if (options.profile != format::Profile::fast) strips.emplace(mesh, tree, options.profile);
    const StripMaker* const strips_if_any = strips ? &*strips : nullptr;
    const auto sizes = leaf_sizes(options.profile, mesh.lattice.bits, strips_if_any);
    const CollapsePlan plan(mesh, tree, *sizes, {options.profile, options.cost_model, options.max_leaf_triangles});

    progress.begin(stages::order);
    const WideTree wide = put_in_order(mesh, tree, plan, strips_if_any);

    progress.begin(stages::encode);
    const OptionalSections sections = make_optional_sections(mesh, options);
    auto blob = encode(*source, mesh, tree, wide, options, properties, sections);
    if (!blob) return blob.error();

    progress.begin(stages::verify);
    if (auto complaint = check_result(*blob, mesh, tree, wide)) return internal_error(*complaint);
    progress.finish();

    baked.blob = std::move(*blob);
    baked.remap = remap_of(*source, mesh, wide);
    fill_in(report, bounds, mesh, wide, properties, baked.blob.size());
    if (lost_closed == LostClosed::reported) report_lost_closed(*source, bounds, report);
    report.volumes = volumes_of(sections, mesh);
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return baked;
}

/// Bakes with the tree that the options choose.
Result<Baked, BakeError> bake_as_chosen(std::span<const MeshView> meshes, const BakeOptions& options,
                                        LostClosed lost_closed) {
    const auto make_tree = [&](const LatticeMesh& mesh, const BuildSettings& settings) {
        return optimise(build(mesh, options.builder, settings), optimise_settings(options.effort));
    };
    return bake_in_stages(make_tree, meshes, options, lost_closed);
}

}  // namespace

Result<Baked, BakeError> bake_with(const TreeMaker& make_tree, std::span<const MeshView> meshes,
                                   const BakeOptions& options) {
    return bake_in_stages(make_tree, meshes, options, LostClosed::reported);
}

Result<Baked, BakeError> bake_trial(std::span<const MeshView> meshes, const BakeOptions& options) {
    return bake_as_chosen(meshes, options, LostClosed::left_out);
}

}  // namespace baker

Result<Baked, BakeError> bake(std::span<const MeshView> meshes, const BakeOptions& options) {
    return baker::bake_as_chosen(meshes, options, baker::LostClosed::reported);
}

}  // namespace espalier
