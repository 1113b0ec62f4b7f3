// The options of the command line, and the models that it chooses from.
#pragma once

#include <string>
#include <vector>

namespace espalier::bench {

struct Options {
    bool json = false;
    std::vector<std::string> profiles;  ///< of those of blobs.hpp; none: all
    unsigned rays = 200'000;
    unsigned poses = 2'000;
    unsigned cubes = 10'000;
    unsigned repetitions = 7;
    unsigned bits = 16;
};

inline constexpr unsigned seed = 2026;

/// Fits the cost of a ray for each mesh and profile, and prints it.
void model_rays(const std::vector<std::string>& meshes, const Options& options);
/// Fits the cost of overlaps() and of distance() of two blobs for each mesh and profile, and prints it.
void model_pairs(const std::vector<std::string>& meshes, const Options& options);
/// Fits the cost of a step of a scene of moving cubes, and prints it.
void model_scene(const Options& options);

}  // namespace espalier::bench
