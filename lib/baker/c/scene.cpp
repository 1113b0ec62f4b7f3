// espalier/c/bake.h: scenes, borders between blobs, and the deep check of blobs and scenes.
#include <espalier/c/bake.h>

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <espalier/scenes/bake.hpp>

#include <baker/c/failure.hpp>
#include <baker/c/result.hpp>
#include <baker/c/structure.hpp>

using namespace espalier;
using namespace espalier::baker;

static_assert(sizeof(Instance) == sizeof(espalier_instance) && std::is_trivially_copyable_v<Instance>);
static_assert(sizeof(Vec3d) == sizeof(espalier_vec3d) && std::is_trivially_copyable_v<Vec3d>);

namespace {

std::span<const std::byte> span_of(const void* bytes, std::size_t count) {
    return {static_cast<const std::byte*>(bytes), count};
}

const espalier_bake_result* refuse(const char* name, const char* count_name, std::size_t count) {
    return make_result(Failure{ESPALIER_BAKE_INVALID_ARGUMENT,
                               std::string(name) + " is null, but " + count_name + " is " + std::to_string(count)},
                       default_memory);
}

/// Returns null if all of the blobs have bytes.
template <class Blob>
const espalier_bake_result* refuse_null(const Blob* blobs, std::size_t blob_count) {
    if (blobs == nullptr && blob_count != 0) return refuse("blobs", "blob_count", blob_count);
    for (std::size_t i = 0; i < blob_count; ++i)
        if (blobs[i].bytes == nullptr && blobs[i].byte_count != 0)
            return refuse(("bytes of blob " + std::to_string(i)).c_str(), "byte_count", blobs[i].byte_count);
    return nullptr;
}

/// Copies an array of C, which may lie at any address.
template <class Value>
std::vector<Value> copy_of(const void* given, std::size_t count) {
    std::vector<Value> values(count);
    if (count != 0) std::memcpy(static_cast<void*>(values.data()), given, count * sizeof(Value));
    return values;
}

/// May throw whatever bake_scene() throws.
const espalier_bake_result* bake_from_c(const espalier_bytes* blobs, std::size_t blob_count,
                                        const espalier_instance* given, std::size_t instance_count,
                                        const espalier_scene_bake_options* given_options) {
    if (const auto* refused = refuse_null(blobs, blob_count)) return refused;
    if (given == nullptr && instance_count != 0) return refuse("instances", "instance_count", instance_count);
    espalier_scene_bake_options read = {};
    if (given_options != nullptr)
        if (auto complaint = read_structure(given_options, sizeof read, "the structure of options", read))
            return make_result(Failure{ESPALIER_BAKE_INVALID_ARGUMENT, std::move(*complaint)}, default_memory);
    std::vector<std::span<const std::byte>> bytes;
    for (const espalier_bytes& blob : std::span(blobs, blob_count))
        bytes.push_back(span_of(blob.bytes, blob.byte_count));
    const auto instances = copy_of<Instance>(given, instance_count);
    const auto translations = copy_of<Vec3d>(read.translations, read.translations == nullptr ? 0 : instance_count);
    SceneBakeOptions options{translations, Vec3d{read.origin.x, read.origin.y, read.origin.z}};
    if (read.chooses_origin != 0) options.origin.reset();
    return make_result(bake_scene(bytes, instances, options), default_memory);
}

/// May throw whatever join_borders() throws.
const espalier_bake_result* join_from_c(const espalier_joined_blob* given, std::size_t count, std::uint64_t* edges) {
    if (const auto* refused = refuse_null(given, count)) return refused;
    std::vector<JoinedBlob> blobs;
    for (const espalier_joined_blob& blob : std::span(given, count))
        blobs.push_back({{static_cast<std::byte*>(blob.bytes), blob.byte_count},
                         {blob.translation.x, blob.translation.y, blob.translation.z}});
    const JoinReport report = join_borders(blobs);
    if (edges != nullptr) *edges = report.edges;
    return make_result(Failure{static_cast<espalier_bake_status>(report.status), report.message}, default_memory);
}

/// Returns the result of a check of bytes.
const espalier_bake_result* checked(const void* bytes, std::size_t count,
                                    VerifyReport (*check)(std::span<const std::byte>)) noexcept {
    return without_exceptions(default_memory, [&] {
        if (bytes == nullptr && count != 0) return refuse("bytes", "byte_count", count);
        const VerifyReport report = check(span_of(bytes, count));
        Failure verdict{ESPALIER_BAKE_NOT_SOUND, report.message};
        if (report) verdict.status = ESPALIER_BAKE_OK;
        return make_result(verdict, default_memory);
    });
}

}  // namespace

void espalier_init_scene_bake_options(espalier_scene_bake_options* options, size_t size) {
    write_defaults(options, size, espalier_scene_bake_options());
}

const espalier_bake_result* espalier_bake_scene(const espalier_bytes* blobs, size_t blob_count,
                                                const espalier_instance* instances, size_t instance_count,
                                                const espalier_scene_bake_options* options) {
    return without_exceptions(default_memory,
                              [&] { return bake_from_c(blobs, blob_count, instances, instance_count, options); });
}

const espalier_bake_result* espalier_join_borders(const espalier_joined_blob* blobs, size_t blob_count,
                                                  uint64_t* edges) {
    if (edges != nullptr) *edges = 0;
    return without_exceptions(default_memory, [&] { return join_from_c(blobs, blob_count, edges); });
}

const espalier_bake_result* espalier_verify(const void* bytes, size_t byte_count) {
    return checked(bytes, byte_count, verify);
}
const espalier_bake_result* espalier_verify_scene(const void* bytes, size_t byte_count) {
    return checked(bytes, byte_count, verify_scene);
}
