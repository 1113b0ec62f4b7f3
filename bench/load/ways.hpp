// Ways from bytes on disk to the first answer: what is shipped, and what happens to it at load.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <espalier/ray.hpp>

#include "mesh_files.hpp"

namespace espalier::bench {

/// What answers rays after a load.
class Loaded {
public:
    Loaded() = default;
    Loaded(const Loaded&) = delete;
    Loaded& operator=(const Loaded&) = delete;
    virtual ~Loaded() = default;
    /// Returns t of the closest hit, or infinity.
    [[nodiscard]] virtual float closest(const Ray& ray) const = 0;
    /// Returns the bytes that queries read and that must stay.
    [[nodiscard]] virtual std::size_t bytes() const = 0;
};

struct Way {
    std::string ships;  ///< what is on disk
    std::string loads;  ///< what happens to it
    Bytes file;
    /// Loads from memory, or from the disk if the file is mapped.
    std::function<std::unique_ptr<Loaded>(std::span<const std::byte> file)> load;
    bool is_mapped = false;  ///< the file is not in memory before
};

// Each appends to the ways. Files are made from the mesh; what meshoptimizer ships, and the blobs, are of 16 bits.
void add_embree_ways(std::vector<Way>& ways, const Mesh& mesh);           ///< where Embree is installed
void add_embree_meshopt_ways(std::vector<Way>& ways, const Bytes& file);  ///< with meshoptimizer too
void add_espalier_ways(std::vector<Way>& ways, const Mesh& mesh);
void add_espalier_meshopt_ways(std::vector<Way>& ways, const Bytes& file);

/// Returns all that this build has. The first is the reference: floats, and Embree's default build.
[[nodiscard]] std::vector<Way> all_ways(const Mesh& mesh);

}  // namespace espalier::bench
