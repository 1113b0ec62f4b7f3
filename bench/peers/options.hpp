// The words behind espalier_bench_peers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "../program.hpp"
#include "system.hpp"

namespace espalier::bench {

struct Options {
    bool json = false;
    std::vector<std::string> systems;  ///< NAME or NAME/PROFILE; none: all
    unsigned repetitions = 9;
    unsigned builds = 3;
    std::size_t incoherent = 500000;
    std::uint64_t seed = 2026;
    BakeSettings bake;
};

void add_options(Program& program, Options& options);

/// Whether --system asks for this one; the reference is always measured.
bool is_asked_for(const Maker& maker, const Options& options);

}  // namespace espalier::bench
