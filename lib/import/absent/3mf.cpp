// In place of import/3mf in a build whose ESPALIER_COMMAND_PARTS has no 3mf.
#include <import/base/error.hpp>
#include <import/base/gzip.hpp>
#include <import/base/importers.hpp>

namespace espalier::importer {

void import_3mf(const std::string& path, const ImportOptions&, ImportResult&) {
    throw_file_error(
        ImportStatus::unsupported, path,
        " is a 3MF, which this build does not read, because it has no expat and zlib. Export it in another "
        "format, such as glTF, or use a build with 3mf.");
}

std::string unpack_gzip(const std::string& path, std::string_view, std::size_t) {
    throw_file_error(ImportStatus::unsupported, path,
                     " is packed by gzip, which this build does not read, because it has no zlib. Unpack it, or use a "
                     "build with 3mf.");
}

}  // namespace espalier::importer
