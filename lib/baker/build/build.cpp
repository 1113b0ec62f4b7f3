#include <baker/build/build.hpp>

#include <array>

#include <baker/base/threads.hpp>
#include <baker/build/agglomerative.hpp>
#include <baker/build/insertion.hpp>
#include <baker/build/linear.hpp>
#include <baker/build/sah.hpp>
#include <baker/build/spatial.hpp>
#include <baker/build/sweep.hpp>

namespace espalier::baker {

BuildSettings build_settings(unsigned effort, unsigned threads) {
    constexpr std::array<unsigned, 10> bins = {16, 16, 24, 24, 32, 32, 48, 48, 64, 64};
    constexpr std::array<unsigned, 10> exact_below = {4, 8, 8, 16, 16, 16, 32, 64, 128, 256};
    constexpr std::array<unsigned, 10> clusters_from = {4, 4, 8, 8, 20, 20, 20, 40, 80, 160};
    constexpr std::array<unsigned, 10> most_insert_places = {32, 64, 64, 128, 128, 256, 256, 512, 1024, 4096};
    BuildSettings settings;
    settings.bins = bins[effort];
    settings.exact_below = exact_below[effort];
    settings.clusters_from = clusters_from[effort];
    settings.most_insert_places = most_insert_places[effort];
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
