// A file of this process.
#pragma once

#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "base.hpp"

namespace espalier::bench {

/// An empty file, which is there as long as the object.
class TemporaryFile {
public:
    TemporaryFile() : name_((std::filesystem::temp_directory_path() / "espalier_bench_XXXXXX").string()) {
        const int file = mkstemp(name_.data());
        if (file < 0) throw std::system_error(errno, std::generic_category(), name_);
        close(file);
    }
    ~TemporaryFile() { unlink(name_.c_str()); }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    [[nodiscard]] std::filesystem::path path() const { return name_; }

private:
    std::string name_;
};

}  // namespace espalier::bench
