#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <espalier/espalier.hpp>

#include "../guide/row.hpp"
#include "../peers/system.hpp"
#include "kernel_walk.hpp"
#include "kernels.hpp"
#include "options.hpp"

namespace espalier::bench {
namespace {

constexpr std::uint64_t seed = 10;

struct AimedRays {
    AimedAt aim;
    std::vector<EdgeRay> rays;
};

std::vector<AimedRays> aim_everywhere(const SnappedMesh& snapped, std::size_t count) {
    std::vector<AimedRays> groups;
    for (const AimedAt aim : all_aims) groups.push_back({aim, edge_rays(snapped, aim, count, seed)});
    return groups;
}

void print_row(const SnappedMesh& snapped, const std::string& system, const AimedRays& group, std::size_t leaks) {
    JsonObject row = guide_row("leaks", snapped.mesh.name, snapped.mesh.triangles.size());
    row.add("system", system);
    row.add("aim", std::string(name_of(group.aim)));
    row.add("rays", group.rays.size());
    row.add("leaks", leaks);
    row.print();
}

template <class Kernel>
void print_kernel(const SnappedMesh& snapped, const AabbTree& tree, const Blob& blob, const std::string& name,
                  const std::vector<AimedRays>& groups) {
    const Kernel kernel(tree, blob);
    for (const AimedRays& group : groups) {
        const auto leaks = std::ranges::count_if(
            group.rays, [&](const EdgeRay& ray) { return is_leak(ray, closest_hit(tree, kernel, ray.ray)); });
        print_row(snapped, name, group, static_cast<std::size_t>(leaks));
    }
}

/// Returns the rays with directions of length 1, as floats represent them: they are no longer exact.
std::vector<AimedRays> with_unit_directions(std::vector<AimedRays> groups) {
    for (AimedRays& group : groups)
        for (EdgeRay& aimed : group.rays) {
            Vec3& d = aimed.ray.direction;
            const float length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
            d = {d.x / length, d.y / length, d.z / length};
            aimed.farthest *= length;
        }
    return groups;
}

void print_system(const SnappedMesh& snapped, System& system, const std::string& name,
                  const std::vector<AimedRays>& groups) {
    for (const AimedRays& group : groups) {
        std::vector<Ray> rays;
        for (const EdgeRay& aimed : group.rays) rays.push_back(aimed.ray);
        std::vector<Hit> hits(rays.size());
        system.closest(rays, false, hits);
        std::size_t leaks = 0;
        for (std::size_t i = 0; i < rays.size(); ++i)
            leaks += is_leak(group.rays[i], hits[i].found ? hits[i].t : std::numeric_limits<float>::infinity());
        print_row(snapped, name, group, leaks);
        if (leaks > 0 && name.starts_with("espalier"))
            throw std::runtime_error(snapped.mesh.name + ": " + std::to_string(leaks) + " rays pass between triangles");
    }
}

/// One of each: variants of a system that test triangles in the same way are left out.
std::vector<Maker> makers() {
    std::vector<Maker> chosen;
    for (Maker& maker : all_makers({})) {
        const bool is_variant = maker.name == "fcl" || maker.profile.starts_with("compact") ||
                                (maker.name == "espalier" && maker.profile != "fast");
        if (!is_variant) chosen.push_back(std::move(maker));
    }
    return chosen;
}

}  // namespace

void print_leaks(const SnappedMesh& snapped, const ExactnessOptions& options) {
    const std::vector<AimedRays> groups = aim_everywhere(snapped, options.aimed);
    const TreeAndBlob built = build_tree_and_blob(snapped.mesh, options.leaf_triangles);
    const Blob blob = open(built.blob);
    print_kernel<MollerTrumbore<float>>(snapped, built.tree, blob, "Möller–Trumbore in float", groups);
    print_kernel<MollerTrumbore<double>>(snapped, built.tree, blob, "Möller–Trumbore in double", groups);
    print_kernel<Watertight>(snapped, built.tree, blob, "watertight in float", groups);
    print_kernel<Integers>(snapped, built.tree, blob, "integers", groups);
    // ODE makes directions unit vectors itself, and counts t in their length.
    const std::vector<AimedRays> unit_groups = with_unit_directions(groups);
    for (const Maker& maker : makers())
        print_system(snapped, *maker.make(snapped.mesh), maker.name + " " + maker.profile,
                     maker.name == "ode" ? unit_groups : groups);
}

}  // namespace espalier::bench
