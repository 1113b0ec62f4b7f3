#include "outputs.hpp"

#include <string>
#include <vector>

#include "files/output_file.hpp"

namespace espalier::tools {

namespace {

std::string depfile_of(const BakeArguments& arguments, const Imported& imported, std::span<const ImportedFile> poses) {
    std::vector<std::string> sources;
    for (const std::span<const ImportedFile> files : {std::span<const ImportedFile>(imported.files), poses}) {
        for (const ImportedFile& file : files) sources.insert(sources.end(), file.opened.begin(), file.opened.end());
    }
    if (!arguments.lattice_of.empty() && arguments.lattice_of != "-") sources.push_back(arguments.lattice_of);
    return depfile_text(arguments.output, sources);
}

}  // namespace

// The depfile is renamed before the result: were it the other way round and the second failed, a change of a file that
// is new to the list would go unnoticed.
void write_outputs(const BakeArguments& arguments, const Imported& imported, std::span<const ImportedFile> poses,
                   const BakeOutputs& outputs) {
    const std::string rule = arguments.depfile.empty() ? std::string() : depfile_of(arguments, imported, poses);
    OutputFiles files;
    if (!arguments.depfile.empty()) files.add(arguments.depfile, std::as_bytes(std::span(rule)));
    if (!arguments.remap.empty()) files.add(arguments.remap, outputs.remap);
    if (!arguments.reorder.empty()) files.add(arguments.reorder, outputs.reordered);
    files.add(arguments.output, outputs.result);
    files.commit();
}

}  // namespace espalier::tools
