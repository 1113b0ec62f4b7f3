#include <baker/build/build.hpp>

#include <array>
#include <cstddef>

#include <baker/base/threads.hpp>
#include <baker/build/agglomerative.hpp>
#include <baker/build/insertion.hpp>
#include <baker/build/linear.hpp>
#include <baker/build/sah.hpp>
#include <baker/build/spatial.hpp>
#include <baker/build/sweep.hpp>

namespace espalier::baker {

BuildSettings build_settings(Effort effort, unsigned threads) {
    constexpr std::array<unsigned, 3> bins = {16, 32, 64};
    constexpr std::array<unsigned, 3> exact_below = {4, 16, 128};
    constexpr std::array<unsigned, 3> clusters_from = {4, 20, 80};
    constexpr std::array<unsigned, 3> most_insert_places = {32, 256, 1024};
    const auto level = static_cast<std::size_t>(effort);
    BuildSettings settings;
    settings.bins = bins[level];
    settings.exact_below = exact_below[level];
    settings.clusters_from = clusters_from[level];
    settings.most_insert_places = most_insert_places[level];
    settings.threads = threads != 0 ? threads : machine_threads();
    return settings;
}

BinaryTree build(const LatticeMesh& mesh, Builder builder, const BuildSettings& settings) {
    if (mesh.triangles.empty()) return {};
    switch (builder) {
        case Builder::binned_sah:
            return build_sah(mesh, settings);
        case Builder::sweep_sah:
            return build_sweep(mesh, settings);
        case Builder::spatial_splits:
            return build_spatial(mesh, settings);
        case Builder::agglomerative:
            return build_agglomerative(mesh, settings);
        case Builder::linear:
            return build_linear(mesh, settings);
        case Builder::insertion:
            return build_insertion(mesh, settings);
    }
    return {};
}

}  // namespace espalier::baker
