// The words behind espalier_bench_peers rays.
#pragma once

#include "../program.hpp"
#include "contest.hpp"
#include "system.hpp"

namespace espalier::bench {

struct Options {
    std::vector<std::string> systems;  ///< NAME or NAME/PROFILE; none: all
    unsigned repetitions = 9;
    unsigned builds = 3;
    std::size_t incoherent = 500000;
    std::uint64_t seed = 2026;
    BakeSettings bake;
};

// Measures every system on one mesh: they take turns at building and at each kind of ray, so that a change of the
// machine's speed hits them alike. A ratio is taken between neighbours in time; a figure is the median of the
// repetitions' ratios, with the smallest and the largest beside it.

/// Nothing where there is no such query, or no reference to take a ratio to.
struct Speed {
    std::optional<Spread> ratio;  ///< the reference's time by one's own: above 1 is faster
    std::optional<double> mrays;  ///< million rays a second, median
};

struct Row {
    std::string system, profile, version;
    double bytes_per_triangle = 0.0;
    double bytes_per_triangle_with_ids = 0.0;
    std::optional<double> bytes_per_triangle_20_bits;
    std::optional<Lattice> lattice;  ///< in the mesh's own units
    Speed incoherent, coherent, any;
    std::optional<Spread> build_ratio;
    double build_seconds = 0.0;
    std::optional<std::size_t> disagreeing;         ///< incoherent rays: hit or miss, against the reference
    std::optional<std::size_t> t_disagreeing;       ///< both hit: t further apart than the lattice and float32 explain
    std::optional<std::size_t> any_contradictions;  ///< any-hit against the same system's closest hit
    std::optional<double> hit_fraction;             ///< of the incoherent rays
};

struct MeshResult {
    std::string mesh;
    std::size_t triangles = 0;
    std::optional<double> load;  ///< the machine's load average of a minute, at the end; a quiet one has about 1: us
    std::vector<Row> rows;
};

/// Throws std::exception when the mesh cannot be read or baked.
MeshResult measure(const std::string& path, const std::vector<Maker>& makers, const Options& options);

/// Prints one JSON object a line for each row; null where a system has no such query and where there is no reference.
void print_rows(const MeshResult& result, const Options& options);

}  // namespace espalier::bench
