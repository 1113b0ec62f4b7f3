#include "instance.hpp"

#include <dlfcn.h>

#include "../temporary_file.hpp"

namespace espalier::bench {

LoadedSide::LoadedSide(const std::filesystem::path& file) {
    const TemporaryFile copy;
    std::filesystem::copy_file(file, copy.path(), std::filesystem::copy_options::overwrite_existing);
    handle_.reset(dlopen(copy.path().c_str(), RTLD_NOW | RTLD_LOCAL));
    if (handle_ == nullptr) throw std::runtime_error(file.string() + ": " + dlerror());
    void* const function = dlsym(handle_.get(), "espalier_side");
    if (function == nullptr)
        throw std::runtime_error(file.string() + ": has no function espalier_side (bench/ab/side.h)");
    calls_ = reinterpret_cast<EspalierSideFunction>(function)();
}

void LoadedSide::Close::operator()(void* handle) const { dlclose(handle); }

Instance::Instance(const SideOfMesh& side, const std::string& set)
    : side_(&side), code_(side.file), blob_(code_->blob_bytes), asset_{nullptr, side.bytes.size(), blob_.data()} {
    set_ = code_->use_set(set.c_str());
    if (set_ == nullptr)
        throw std::runtime_error(side.file.string() + ": no instruction set " + set + " in this commit or processor");
}

void Instance::move_to(const Memory& memory) {
    std::memcpy(memory.data(), side_->bytes.data(), side_->bytes.size());
    asset_.bytes = memory.data();
    if (const char* why = code_->open(&asset_)) throw std::runtime_error(side_->file.string() + ": " + why);
}

PairOfInstances::PairOfInstances(const SideOfMesh& base, const SideOfMesh& other, const std::string& set)
    : sides_{Instance(base, set), Instance(other, set)},
      places_{Memory(std::max(base.bytes.size(), other.bytes.size())),
              Memory(std::max(base.bytes.size(), other.bytes.size()))} {
    place(false);
}

void PairOfInstances::place(bool exchanged) {
    for (const std::size_t place : {std::size_t{0}, std::size_t{1}})
        sides_[exchanged ? 1 - place : place].move_to(places_[place]);
}

SideOfMesh bake_with(const std::filesystem::path& file, const Mesh& mesh, const std::string& profile, unsigned bits) {
    std::vector<float> positions;
    std::vector<std::uint32_t> corners;
    for (const Vec3& p : mesh.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
    for (const TriangleVertices& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
    const EspalierSideMesh view = {mesh.name.c_str(), positions.data(), mesh.positions.size(), corners.data(),
                                   mesh.triangles.size()};
    const LoadedSide code(file);
    SideOfMesh side = {file, {}};
    const auto take = [](void* to, const void* baked, std::size_t size) {
        const auto* first = static_cast<const std::byte*>(baked);
        static_cast<std::vector<std::byte>*>(to)->assign(first, first + size);
    };
    if (const char* why = code->bake(&view, profile.c_str(), bits, take, &side.bytes))
        throw std::runtime_error(file.string() + ": " + why);
    return side;
}

}  // namespace espalier::bench
