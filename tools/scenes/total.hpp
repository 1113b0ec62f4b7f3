// The reports of several bakes as one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <espalier/bake.hpp>

namespace espalier::tools {

/// Adds up the reports of the meshes of a scene: triangles and findings count once for each instance. Of the tree only
/// the triangles are added, up to the most that their type holds.
class ReportTotal {
public:
    /// `name` is that of the mesh; empty for the merged mesh.
    void add(const BakeReport& report, const std::string& name, std::uint64_t instances);
    /// Returns the sums, with one warning of each kind: that of the first mesh, and how many meshes have one.
    [[nodiscard]] BakeReport report() const;

private:
    struct CountedWarning {
        BakeWarning first;
        std::uint64_t meshes;
    };
    BakeReport sum_;
    std::vector<CountedWarning> warnings_;
};

}  // namespace espalier::tools
