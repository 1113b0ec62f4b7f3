#include "deformable_mesh.hpp"

#include <array>
#include <stdexcept>
#include <string>

#include <espalier/format.hpp>

#include "processor_time.hpp"

namespace espalier::bench {
namespace {

std::size_t load_u32(std::span<const std::byte> bytes, std::size_t at) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<std::size_t>(bytes[at + i]) << (8 * i);
    return value;
}

RefitWork work_of(const BakeResult& baked) {
    RefitWork work;
    work.nodes = baked.report.tree.nodes;
    work.leaves = baked.report.tree.leaves;
    work.leaf_vertices = load_u32(baked.bytes, format::header::vertex_slots_at);
    work.moving_bytes = baked.report.motion.moving_bytes;
    work.source_bytes = work.leaf_vertices * format::vertex_sources::number_bits(baked.report.motion.positions) / 8;
    work.still_bytes = baked.bytes.size() - work.moving_bytes - work.source_bytes;
    work.step = baked.report.lattice.step;
    return work;
}

}  // namespace

DeformableMesh::DeformableMesh(const Mesh& mesh, const DeformableOptions& options) {
    BakeOptions bake_options;
    bake_options.profile = Profile::fast;
    bake_options.resolution = Resolution::bits(options.bits);
    bake_options.effort = options.effort;
    bake_options.build.max_leaf_triangles = options.max_leaf_triangles;
    bake_options.deformation = Deformation{options.range, options.poses};
    const ProcessorTime time;
    BakeResult baked = bake(std::array{mesh.view()}, bake_options);
    bake_seconds_ = time.seconds();
    if (!baked) throw std::runtime_error(mesh.name + ": " + baked.message);
    work_ = work_of(baked);
    bytes_ = std::move(baked.bytes);
    memory_.resize(work_.moving_bytes);
    deformable_ = create_deformable(open(bytes_), memory_);
    if (!deformable_) throw std::runtime_error(mesh.name + ": " + describe(deformable_.status()));
}

float DeformableMesh::move(std::span<const Vec3> positions) {
    const RefitResult result = refit(positions);
    if (!result)
        throw std::runtime_error("position " + std::to_string(result.position) + ": " + describe(result.status));
    return result.quality;
}

}  // namespace espalier::bench
