#include <baker/scenes/part.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <espalier/scenes/bake.hpp>
#include <espalier/format.hpp>
#include <runtime/base/bits.hpp>

#include <baker/base/float_rounding.hpp>

namespace espalier::baker {

namespace {

Refusal refused(std::string message) { return {BakeStatus::invalid_mesh, std::move(message)}; }

}  // namespace

Expected<ScenePart> ScenePart::open(std::span<const std::byte> bytes) {
    if (bytes.size() < 4 || detail::load_u32(bytes.data()) != format::scene::magic) {
        const Blob mesh = espalier::open(bytes);
        if (!mesh) return refused(describe(mesh.status()));
        return ScenePart(mesh);
    }
    if (tile_count_of_scene(bytes) != 0) return refused("it is a scene with tiles, and tiles hold no tiles");
    std::vector<Blob> meshes(mesh_count_of_scene(bytes));
    const BakedScene tile = open_scene(bytes, meshes);
    if (!tile) return refused(describe(tile.status()));
    ScenePart part(tile);
    part.meshes_ = std::move(meshes);
    return part;
}

std::uint64_t ScenePart::triangle_count() const {
    if (!is_tile()) return mesh_.triangle_count();
    std::uint64_t count = 0;
    for (std::uint32_t i = 0; i < tile_.instance_count(); ++i)
        count += tile_.meshes()[instance_at(tile_, {i})->mesh].triangle_count();
    return count;
}

std::optional<espalier::Lattice> ScenePart::lattice() const {
    if (!is_tile()) return mesh_.triangle_count() != 0 ? std::optional(mesh_.lattice()) : std::nullopt;
    const Result<espalier::Lattice> common = tile_.common_lattice();
    return common ? std::optional(*common) : std::nullopt;
}

double ScenePart::finest_step() const {
    const auto step_of = [](const Blob& mesh) {
        return mesh.triangle_count() == 0 ? std::numeric_limits<double>::infinity()
                                          : std::ldexp(1.0, mesh.lattice().step_exponent);
    };
    if (!is_tile()) return step_of(mesh_);
    double finest = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < tile_.instance_count(); ++i) {
        const Instance instance = *instance_at(tile_, {i});
        finest = std::min(finest, double(instance.transform.scale) * step_of(tile_.meshes()[instance.mesh]));
    }
    return finest;
}

float ScenePart::error_at(const Transform& transform, double moved) const {
    const double of_part = double(tree().max_error) * double(transform.scale);  // exact
    return round_up_to_float(moved == 0.0 ? of_part : (of_part + moved) * (1.0 + 0x1p-50));
}

std::optional<std::string> ScenePart::find_fault() const {
    const VerifyReport report = is_tile() ? verify_scene(bytes()) : verify(bytes());
    return report ? std::nullopt : std::optional(report.message);
}

}  // namespace espalier::baker
