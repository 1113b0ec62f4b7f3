#include <import/3mf/package.hpp>

#include <deque>

#include <import/3mf/xml.hpp>
#include <import/3mf/zip_archive.hpp>
#include <import/base/error.hpp>
#include <import/base/text_file.hpp>

namespace espalier::importer {

namespace {

constexpr const char* usual_model = "3D/3dmodel.model";
constexpr const char* relationships = "_rels/.rels";
constexpr std::string_view model_relationship = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";

/// The paths of the models that a package begins with.
class RootModels : public XmlHandler {
public:
    std::vector<std::string> paths;

    void begin(const XmlElement& element) override {
        if (element.name() != "Relationship" || element.attribute("Type") != model_relationship) return;
        if (element.attribute("TargetMode") == "External") return;
        if (const auto target = element.attribute("Target")) paths.emplace_back(*target);
    }
};

/// Files without the relationship have the model where all programs write it.
std::string root_model(const ImportedFile& file, const ZipArchive& archive) {
    RootModels models;
    if (archive.has(relationships)) {
        parse_xml(text('\'', printable(file.path), "', ", relationships), archive.read(relationships), models);
    }
    if (models.paths.size() > 1) {
        throw_file_error(ImportStatus::invalid_input, file.path, ": it names ", models.paths.size(), " models, '",
                         printable(models.paths[0]), "' and '", printable(models.paths[1]),
                         "' first, and 3MF has one. Export it again.");
    }
    const std::string path = model_path(models.paths.empty() ? usual_model : models.paths[0]);
    if (!archive.has(path)) {
        throw_file_error(ImportStatus::invalid_input, file.path,
                         " is no whole 3MF: it is a zip archive without the model '", printable(path),
                         "'. Copy or export it again.");
    }
    return path;
}

}  // namespace

std::size_t ThreeMfPackage::model_number(std::string_view reference) {
    const auto [place, is_new] = model_numbers.try_emplace(ZipArchive::key_of(reference), models.size());
    if (is_new) models.push_back(model_path(reference));
    return place->second;
}

ThreeMfPackage read_3mf_package(const ImportOptions& options, ImportedFile& file) {
    const ZipArchive archive(file.path, read_bytes(file.path));
    ThreeMfPackage package;
    std::deque<std::size_t> waiting = {package.model_number(root_model(file, archive))};
    std::vector<bool> is_known = {true};  // of the package's models: read or waiting
    for (bool is_root = true; !waiting.empty(); is_root = false) {
        const std::size_t model = waiting.front();
        waiting.pop_front();
        const std::size_t first = package.objects.size();
        read_3mf_model(model, archive.read(package.models[model]), options, file, package);
        const auto wait_for = [&](const std::vector<ThreeMfUse>& uses) {
            for (const ThreeMfUse& use : uses) {
                if (!is_known[use.model]) waiting.push_back(use.model);
                is_known[use.model] = true;
            }
        };
        is_known.resize(package.models.size());
        if (is_root) wait_for(package.items);
        for (std::size_t i = first; i < package.objects.size(); ++i) wait_for(package.objects[i].components);
        show_reading(options, static_cast<double>(is_known.size() - waiting.size()),
                     static_cast<double>(is_known.size()));
    }
    return package;
}

}  // namespace espalier::importer
