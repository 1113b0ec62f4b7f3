// espalier/c/bake.h: a bake from arrays of C to a result of C.
#include <espalier/c/bake.h>

#include <optional>
#include <string>
#include <string_view>

#include <espalier/bake.hpp>

#include <baker/c/arrays.hpp>
#include <baker/c/failure.hpp>
#include <baker/c/options.hpp>
#include <baker/c/result.hpp>
#include <baker/c/structure.hpp>

using namespace espalier;
using namespace espalier::baker;

static_assert(static_cast<std::uint8_t>(BakeStatus::internal) == ESPALIER_BAKE_INTERNAL &&
              static_cast<std::uint8_t>(BakeStatus::too_large) == ESPALIER_BAKE_TOO_LARGE);

namespace {

/// May throw whatever bake() and the callbacks throw.
const espalier_bake_result* bake_from_c(const espalier_mesh_view* given, std::size_t count,
                                        const espalier_bake_options& options, const ResultMemory& memory) {
    MeshArrays meshes;
    if (const auto failure = meshes.read(given, count)) return make_result(*failure, memory);
    BakeOptions translated;
    if (const auto failure = translate(options, meshes.position_count(), translated))
        return make_result(*failure, memory);
    return make_result(bake(meshes.views(), translated), options.with_remap != 0, memory);
}

}  // namespace

void espalier_init_mesh_view(espalier_mesh_view* mesh, size_t size) { write_defaults(mesh, size, default_mesh_view()); }

void espalier_init_bake_options(espalier_bake_options* options, size_t size) {
    write_defaults(options, size, default_options());
}

const espalier_bake_result* espalier_bake(const espalier_mesh_view* meshes, size_t mesh_count,
                                          const espalier_bake_options* options) {
    ResultMemory memory = default_memory;
    return without_exceptions(memory, [&] {
        espalier_bake_options read;
        const auto failure = read_options(options, read);
        memory = memory_of(read);
        return failure ? make_result(*failure, memory) : bake_from_c(meshes, mesh_count, read, memory);
    });
}

void espalier_release_bake_result(const espalier_bake_result* result) { release_result(result); }

const char* espalier_describe_bake_status(espalier_bake_status status) {
    switch (status) {
        case ESPALIER_BAKE_OK:
            return "the meshes were baked";
        case ESPALIER_BAKE_INVALID_OPTIONS:
            return "an option is out of its range, or two exclude each other";
        case ESPALIER_BAKE_INVALID_MESH:
            return "a triangle has a corner that is not finite, or a vertex that does not exist";
        case ESPALIER_BAKE_TOO_FINE:
            return "the resolution would need more than 24 bits";
        case ESPALIER_BAKE_TOO_LARGE:
            return "the meshes exceed a limit of the format";
        case ESPALIER_BAKE_INTERNAL:
            return "the baker refused its own result: an error in the baker";
        case ESPALIER_BAKE_INVALID_ARGUMENT:
            return "an argument is null, or a structure or an array has a wrong size";
        case ESPALIER_BAKE_NO_MEMORY:
            return "there is not enough memory";
        case ESPALIER_BAKE_STOPPED:
            return "the progress callback ended the bake";
        case ESPALIER_BAKE_NOT_SOUND:
            return "the blob or scene is not what its header states";
        default:
            return "this is no status of a bake";
    }
}

size_t espalier_size_of_baking(const char* name) {
    if (name == nullptr) return 0;
    const std::string_view structure = name;
    if (structure == "mesh_view") return sizeof(espalier_mesh_view);
    if (structure == "bake_options") return sizeof(espalier_bake_options);
    if (structure == "scene_bake_options") return sizeof(espalier_scene_bake_options);
    if (structure == "bake_result") return sizeof(espalier_bake_result);
    if (structure == "bake_report") return sizeof(espalier_bake_report);
    if (structure == "bake_finding") return sizeof(espalier_bake_finding);
    if (structure == "bake_warning") return sizeof(espalier_bake_warning);
    if (structure == "source_place") return sizeof(espalier_source_place);
    if (structure == "bytes") return sizeof(espalier_bytes);
    if (structure == "joined_blob") return sizeof(espalier_joined_blob);
    return 0;
}
