// A program that bakes a mesh file.
#include <array>
#include <cstdio>
#include <string>

#include <espalier/bake.hpp>
#include <espalier/import.hpp>

int main(int count, char** arguments) {
    const std::array<std::string, 1> paths = {count > 1 ? arguments[1] : ""};
    espalier::ImportOptions options;
    options.separate_process = true;
    const espalier::ImportResult imported = espalier::import_meshes(paths, options);
    if (!imported) {
        std::printf("%s\n", imported.reason.message.c_str());
        return 1;
    }
    const auto baked = espalier::bake(imported.views());
    if (!baked) return 1;
    std::printf("baked %u triangles of %s\n", static_cast<unsigned>(baked.report.tree.triangles),
                imported.files.front().format.c_str());
    return 0;
}
