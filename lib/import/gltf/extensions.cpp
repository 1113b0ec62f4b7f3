#include <import/gltf/extensions.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <import/base/numbers.hpp>

namespace espalier::importer {

namespace {

constexpr std::array<std::string_view, 5> read_here = {"CESIUM_RTC", "EXT_mesh_gpu_instancing",
                                                       "EXT_meshopt_compression", "KHR_draco_mesh_compression",
                                                       "KHR_mesh_quantization"};

/// Materials, pictures, lights, animations and data about the file. A name that ends with '_' stands for all that
/// start so.
constexpr std::array<std::string_view, 20> harmless_extensions = {
    "ADOBE_materials_",  "AGI_articulations", "EXT_instance_features", "EXT_lights_",         "EXT_materials_",
    "EXT_mesh_features", "EXT_mesh_manifold", "EXT_structural_",       "EXT_texture_",        "FB_ngon_encoding",
    "KHR_animation_",    "KHR_lights_",       "KHR_materials_",        "KHR_technique_webgl", "KHR_techniques_webgl",
    "KHR_texture_",      "KHR_xmp_",          "MSFT_packing_",         "MSFT_texture_",       "KHR_xmp"};

bool is_harmless(std::string_view name) {
    return std::any_of(harmless_extensions.begin(), harmless_extensions.end(), [name](std::string_view known) {
        return known.ends_with('_') ? name.starts_with(known) : name == known;
    });
}

std::string_view way_out(std::string_view name) {
    if (name == "KHR_meshopt_compression") return "Pack it with EXT_meshopt_compression, or without compression.";
    return "Export it without this extension, or in another format.";
}

}  // namespace

void require_known_gltf_extensions(const GltfObject& root) {
    for (std::size_t i = 0; i < root.size_of("extensionsRequired"); ++i) {
        const std::string name = root.text_in("extensionsRequired", i);
        if (std::find(read_here.begin(), read_here.end(), name) != read_here.end() || is_harmless(name)) continue;
        root.refuse(text("it requires the glTF extension ", printable(name), ", which is not read. ", way_out(name)));
    }
}

}  // namespace espalier::importer
