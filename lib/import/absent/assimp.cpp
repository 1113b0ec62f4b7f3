// In place of import/assimp in a build whose ESPALIER_COMMAND_PARTS has no assimp.
#include <import/base/error.hpp>
#include <import/base/importers.hpp>

namespace espalier::importer {

void import_with_assimp(const std::string& path, const ImportOptions&, ImportResult&) {
    throw_file_error(ImportStatus::unsupported, path,
                     " cannot be imported: it is no 3MF, OBJ, OFF, PLY, STL, RAW or glTF, and this ",
                     "build reads no other format, because it has no assimp. Convert it, for example to glTF, ",
                     "or use a build with assimp.");
}

}  // namespace espalier::importer
