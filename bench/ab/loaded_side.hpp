// A shared object that was built of one commit (side.h), loaded.
#pragma once

#include <filesystem>

#include "side.h"

namespace espalier::bench {

/// Each object is a mapping of its own, also of one file loaded twice: the loader is given a copy of the file. So the
/// code of two loads lies at different addresses, and neither shares a variable with the other.
class LoadedSide {
public:
    /// Throws std::runtime_error, which names the file.
    explicit LoadedSide(const std::filesystem::path& file);
    ~LoadedSide();
    LoadedSide(const LoadedSide&) = delete;
    LoadedSide& operator=(const LoadedSide&) = delete;
    LoadedSide(LoadedSide&& other) noexcept;
    LoadedSide& operator=(LoadedSide&&) = delete;

    const EspalierSide* operator->() const { return calls_; }

private:
    void* handle_;
    const EspalierSide* calls_;
};

}  // namespace espalier::bench
