// Blobs that are opened, and blobs that are baked at load.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <fstream>

#include "../../tools/base/choices.hpp"
#include "../temporary_file.hpp"
#include "ways.hpp"

namespace espalier::bench {
namespace {

class BlobLoaded final : public Loaded {
public:
    /// `owner` keeps the bytes of the blob, unless the caller does.
    explicit BlobLoaded(Blob blob, std::shared_ptr<const void> owner = nullptr)
        : blob_(blob), owner_(std::move(owner)) {
        if (!blob_) throw std::runtime_error(describe(blob_.status()));
    }
    [[nodiscard]] float closest(const Ray& ray) const override { return raycast(blob_, ray).t; }
    [[nodiscard]] std::size_t bytes() const override { return blob_.size(); }

private:
    Blob blob_;
    std::shared_ptr<const void> owner_;
};

/// Maps a file for as long as it lives.
class Mapping {
public:
    explicit Mapping(const std::filesystem::path& path) {
        const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
        if (file < 0) throw std::system_error(errno, std::generic_category(), path.string());
        size_ = std::filesystem::file_size(path);
        data_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
        close(file);
        if (data_ == MAP_FAILED) throw std::system_error(errno, std::generic_category(), path.string());
    }
    ~Mapping() { munmap(data_, size_); }
    Mapping(const Mapping&) = delete;
    Mapping& operator=(const Mapping&) = delete;
    [[nodiscard]] std::span<const std::byte> bytes() const { return {static_cast<const std::byte*>(data_), size_}; }

private:
    void* data_;
    std::size_t size_;
};

Bytes bake_mesh(const MeshView& view, Profile profile, Effort effort) {
    BakeResult baked = bake({&view, 1}, {.profile = profile, .effort = effort});
    if (!baked) throw std::runtime_error(baked.message);
    return std::move(baked.bytes);
}

}  // namespace

void add_espalier_ways(std::vector<Way>& ways, const Mesh& mesh) {
    for (const auto& [name, profile] : tools::profile_choices) {
        const Bytes blob = bake_mesh(mesh.view(), profile, Effort::normal);
        ways.push_back({"blob, " + name, "open", blob, [](std::span<const std::byte> file) -> std::unique_ptr<Loaded> {
                            return std::make_unique<BlobLoaded>(open(file));
                        }});
        const auto on_disk = std::make_shared<TemporaryFile>();
        std::ofstream(on_disk->path(), std::ios::binary)
            .write(reinterpret_cast<const char*>(blob.data()), static_cast<std::streamsize>(blob.size()));
        ways.push_back({"blob, " + name, "map, open_unchecked", blob,
                        [on_disk](std::span<const std::byte>) -> std::unique_ptr<Loaded> {
                            const auto mapping = std::make_shared<Mapping>(on_disk->path());
                            return std::make_unique<BlobLoaded>(open_unchecked(mapping->bytes()), mapping);
                        },
                        true});
    }
}

#ifdef ESPALIER_BENCH_MESHOPT
void add_espalier_meshopt_ways(std::vector<Way>& ways, const Bytes& file) {
    for (const Profile profile : {Profile::fast, Profile::balanced})
        ways.push_back({"meshoptimizer", "bake, " + tools::name_in(tools::profile_choices, profile), file,
                        [profile](std::span<const std::byte> shipped) -> std::unique_ptr<Loaded> {
                            // The decoded mesh is released once it is baked.
                            const auto bytes = std::make_shared<Bytes>(
                                bake_mesh(decoded(shipped, read_meshopt).view(), profile, Effort::fast));
                            return std::make_unique<BlobLoaded>(open(*bytes), bytes);
                        }});
}
#endif

}  // namespace espalier::bench
