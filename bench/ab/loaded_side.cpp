#include "loaded_side.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include <dlfcn.h>
#include <stdlib.h>
#include <unistd.h>

namespace espalier::bench {
namespace {

/// A file that is there as long as the object.
class TemporaryCopy {
public:
    explicit TemporaryCopy(const std::filesystem::path& file)
        : path_((std::filesystem::temp_directory_path() / "espalier_side_XXXXXX").string()) {
        const int descriptor = mkstemp(path_.data());
        if (descriptor < 0) throw std::runtime_error(path_ + ": cannot be made");
        close(descriptor);
        std::filesystem::copy_file(file, path_, std::filesystem::copy_options::overwrite_existing);
    }
    ~TemporaryCopy() { unlink(path_.c_str()); }
    TemporaryCopy(const TemporaryCopy&) = delete;
    TemporaryCopy& operator=(const TemporaryCopy&) = delete;
    [[nodiscard]] const char* path() const { return path_.c_str(); }

private:
    std::string path_;
};

}  // namespace

LoadedSide::LoadedSide(const std::filesystem::path& file) {
    const TemporaryCopy copy(file);
    handle_ = dlopen(copy.path(), RTLD_NOW | RTLD_LOCAL);
    if (handle_ == nullptr) throw std::runtime_error(file.string() + ": " + dlerror());
    void* const function = dlsym(handle_, "espalier_side");
    if (function == nullptr) {
        dlclose(handle_);
        throw std::runtime_error(file.string() + ": has no function espalier_side (bench/ab/side.h)");
    }
    calls_ = reinterpret_cast<EspalierSideFunction>(function)();
}

LoadedSide::LoadedSide(LoadedSide&& other) noexcept
    : handle_(std::exchange(other.handle_, nullptr)), calls_(other.calls_) {}

LoadedSide::~LoadedSide() {
    if (handle_ != nullptr) dlclose(handle_);
}

}  // namespace espalier::bench
