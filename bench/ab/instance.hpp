// A shared object that was built of one commit (side.h), loaded.
#pragma once

#include <filesystem>

#include "../memory.hpp"
#include "side.h"

namespace espalier::bench {

/// Each object is a mapping of its own, also of one file loaded twice: the loader is given a copy of the file. So the
/// code of two loads lies at different addresses, and neither shares a variable with the other.
class LoadedSide {
public:
    /// Throws std::runtime_error, which names the file.
    explicit LoadedSide(const std::filesystem::path& file);

    const EspalierSide* operator->() const { return calls_; }

private:
    struct Close {
        void operator()(void* handle) const;
    };
    std::unique_ptr<void, Close> handle_;
    const EspalierSide* calls_;
};

// A load of a side's code, and a pair of them: each has its own copy of the bytes that its side baked.

/// What a commit makes of a mesh.
struct SideOfMesh {
    std::filesystem::path file;  ///< the shared object
    std::vector<std::byte> bytes;
};

/// Bakes with the commit of the shared object. Throws std::runtime_error with the commit's own message.
SideOfMesh bake_with(const std::filesystem::path& file, const Mesh& mesh, const std::string& profile, unsigned bits);

class Instance {
public:
    /// Throws std::runtime_error where the commit or the processor has no such instruction set.
    Instance(const SideOfMesh& side, const std::string& set);

    /// Copies the bytes to `memory` and opens them there. Throws std::runtime_error where the commit refuses them.
    void move_to(const Memory& memory);

    [[nodiscard]] const EspalierSide& calls() const { return *code_.operator->(); }
    [[nodiscard]] const EspalierSideAsset& asset() const { return asset_; }
    [[nodiscard]] const char* set() const { return set_; }

private:
    const SideOfMesh* side_;
    LoadedSide code_;
    Memory blob_;
    EspalierSideAsset asset_;
    const char* set_;
};

/// A load of each side and two places for their bytes. Which pages a copy is given decides several per cent of a ray's
/// time in a large mesh, so the sides exchange places.
class PairOfInstances {
public:
    PairOfInstances(const SideOfMesh& base, const SideOfMesh& other, const std::string& set);
    void place(bool exchanged);
    [[nodiscard]] const Instance& base() const { return sides_[0]; }
    [[nodiscard]] const Instance& other() const { return sides_[1]; }

private:
    std::array<Instance, 2> sides_;
    std::array<Memory, 2> places_;
};

}  // namespace espalier::bench
