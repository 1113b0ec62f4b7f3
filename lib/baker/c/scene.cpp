// espalier/c/bake.h: scenes, borders between blobs, and the deep check of blobs and scenes.
#include <espalier/c/bake.h>

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/scene.hpp>

#include <baker/c/failure.hpp>
#include <baker/c/result.hpp>

using namespace espalier;
using namespace espalier::baker;

static_assert(sizeof(Instance) == sizeof(espalier_instance) && std::is_trivially_copyable_v<Instance>);

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

/// May throw whatever bake_scene() throws.
const espalier_bake_result* bake_from_c(const espalier_bytes* blobs, std::size_t blob_count,
                                        const espalier_instance* given, std::size_t instance_count) {
    if (const auto* refused = refuse_null(blobs, blob_count)) return refused;
    if (given == nullptr && instance_count != 0) return refuse("instances", "instance_count", instance_count);
    std::vector<std::span<const std::byte>> bytes;
    for (const espalier_bytes& blob : std::span(blobs, blob_count))
        bytes.push_back(span_of(blob.bytes, blob.byte_count));
    std::vector<Instance> instances(instance_count);
    if (instance_count != 0)
        std::memcpy(static_cast<void*>(instances.data()), given, instance_count * sizeof(Instance));
    return make_result(bake_scene(bytes, instances), default_memory);
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

const espalier_bake_result* espalier_bake_scene(const espalier_bytes* blobs, size_t blob_count,
                                                const espalier_instance* instances, size_t instance_count) {
    return without_exceptions(default_memory,
                              [&] { return bake_from_c(blobs, blob_count, instances, instance_count); });
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
