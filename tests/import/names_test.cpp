// Claims about the names that a program looks up by the numbers which a blob stores.
#include <cstdint>
#include <iterator>
#include <string_view>

#include <doctest/doctest.h>

#include <espalier/import.hpp>

namespace espalier::tests::import_names_test {
namespace {

TEST_CASE("import: a number of a material is counted on from the files before") {
    ImportResult imported;
    imported.files.resize(3);
    imported.files[0].materials = 2;
    imported.files[0].material_names = {"oak", "steel"};
    imported.files[1].materials = 1;  // which has no name
    imported.files[2].materials = 3;
    imported.files[2].material_names = {"glass", "", "rubber"};
    const std::string_view expected[] = {"oak", "steel", "", "glass", "", "rubber", ""};
    for (std::uint32_t i = 0; i < std::size(expected); ++i) CHECK(imported.material_name(i) == expected[i]);
    CHECK(imported.material_name(0xffffffffu).empty());
    CHECK(ImportResult{}.material_name(0).empty());
}

TEST_CASE("import: the source of a triangle has the names of its mesh in its file") {
    ImportResult imported;
    imported.files.resize(2);
    imported.files[0].mesh_names = {"table"};
    imported.files[1].mesh_names = {"door", "wall"};
    imported.files[1].mesh_paths = {"House/Door_02"};
    const auto source_of = [](std::uint32_t file, std::uint32_t mesh) {
        OriginalTriangle source;
        source.file = file;
        source.mesh = mesh;
        return source;
    };
    CHECK(imported.mesh_name(source_of(0, 0)) == "table");
    CHECK(imported.mesh_name(source_of(1, 1)) == "wall");
    CHECK(imported.mesh_path(source_of(1, 0)) == "House/Door_02");
    CHECK(imported.mesh_path(source_of(1, 1)).empty());
    for (const OriginalTriangle& nothing : {source_of(0, 1), source_of(2, 0), source_of(0xffffffffu, 0xffffffffu)}) {
        CHECK(imported.mesh_name(nothing).empty());
        CHECK(imported.mesh_path(nothing).empty());
    }
}

}  // namespace
}  // namespace espalier::tests::import_names_test
