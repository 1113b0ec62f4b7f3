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

class BlobLoaded : public Loaded {
public:
    explicit BlobLoaded(Blob blob) : blob_(blob) {
        if (!blob_) throw std::runtime_error(describe(blob_.status()));
    }
    [[nodiscard]] float closest(const Ray& ray) const override { return raycast(blob_, ray).t; }
    [[nodiscard]] std::size_t bytes() const override { return blob_.size(); }

private:
    Blob blob_;
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

class MappedBlob final : public Loaded {
public:
    explicit MappedBlob(const std::filesystem::path& path) : mapping_(path), blob_(open_unchecked(mapping_.bytes())) {}
    [[nodiscard]] float closest(const Ray& ray) const override { return blob_.closest(ray); }
    [[nodiscard]] std::size_t bytes() const override { return blob_.bytes(); }

private:
    Mapping mapping_;
    BlobLoaded blob_;
};

Bytes bake_mesh(const MeshView& view, Profile profile, Effort effort) {
    BakeResult baked = bake({&view, 1}, {.profile = profile, .effort = effort});
    if (!baked) throw std::runtime_error(baked.message);
    return std::move(baked.bytes);
}

#ifdef ESPALIER_BENCH_MESHOPT

struct Decoded {
    explicit Decoded(std::span<const std::byte> file) {
        const MeshCounts counts = read_counts(file);
        positions.resize(counts.vertices);
        triangles.resize(counts.triangles);
        read_meshopt(file, {&positions.data()->x, triangles.data()->data()});
    }
    std::vector<Vec3> positions;
    std::vector<TriangleVertices> triangles;
};

/// The decoded mesh is released once it is baked.
class BakedAtLoad final : public Loaded {
public:
    BakedAtLoad(std::span<const std::byte> file, Profile profile)
        : bytes_(bake_file(file, profile)), blob_(open(bytes_)) {}
    [[nodiscard]] float closest(const Ray& ray) const override { return blob_.closest(ray); }
    [[nodiscard]] std::size_t bytes() const override { return blob_.bytes(); }

private:
    static Bytes bake_file(std::span<const std::byte> file, Profile profile) {
        const Decoded mesh(file);
        MeshView view;
        view.positions = mesh.positions;
        view.triangles = mesh.triangles;
        return bake_mesh(view, profile, Effort::fast);
    }

    Bytes bytes_;
    BlobLoaded blob_;
};

#endif

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
                            return std::make_unique<MappedBlob>(on_disk->path());
                        },
                        true});
    }
}

#ifdef ESPALIER_BENCH_MESHOPT
void add_espalier_meshopt_ways(std::vector<Way>& ways, const Bytes& file) {
    for (const Profile profile : {Profile::fast, Profile::balanced})
        ways.push_back({"meshoptimizer", "bake, " + tools::name_in(tools::profile_choices, profile), file,
                        [profile](std::span<const std::byte> bytes) -> std::unique_ptr<Loaded> {
                            return std::make_unique<BakedAtLoad>(bytes, profile);
                        }});
}
#endif

}  // namespace espalier::bench
