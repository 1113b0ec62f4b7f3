// answers FOLDER: bakes FOLDER/positions and FOLDER/triangles twice, writes FOLDER/blob, FOLDER/coarse_blob and
// FOLDER/scene, and queries them with the arrays of float32 FOLDER/origins, directions, limits, radii, vertices and
// planes, and those of uint32 FOLDER/vertexOffsets and planeOffsets. Writes the answers of each query to a file of its
// name, as words in the order of the fields. Each comes from one call of C++ for each question.
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/espalier.hpp>

#include "questions.hpp"
#include "words.hpp"

std::string folder;

void write_file(const std::string& name, const void* bytes, std::size_t size) {
    std::FILE* const file = std::fopen((folder + name).c_str(), "wb");
    if (file == nullptr) return;
    std::fwrite(bytes, 1, size, file);
    std::fclose(file);
}

Words::~Words() { write_file(name_, words_.data(), sizeof(std::uint32_t) * words_.size()); }

namespace {

template <class Element>
std::vector<Element> read(const char* name) {
    std::vector<Element> elements;
    std::FILE* const file = std::fopen((folder + name).c_str(), "rb");
    if (file == nullptr) return elements;
    for (Element element; std::fread(&element, sizeof element, 1, file) == 1;) elements.push_back(element);
    std::fclose(file);
    return elements;
}

espalier::BakeResult bake(const espalier::MeshView& mesh, const espalier::BakeOptions& options, const char* name) {
    espalier::BakeResult baked = espalier::bake(std::span(&mesh, 1), options);
    if (!baked) {
        std::fprintf(stderr, "answers: %s\n", baked.message.c_str());
        std::exit(2);
    }
    write_file(name, baked.bytes.data(), baked.bytes.size());
    return baked;
}

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 2) {
        std::fputs("usage: answers FOLDER\n", stderr);
        return 1;
    }
    folder = std::string(arguments[1]) + "/";
    const auto positions = read<espalier::Vec3>("positions");
    const auto triangles = read<espalier::TriangleVertices>("triangles");
    espalier::MeshView mesh;
    mesh.positions = positions;
    mesh.triangles = triangles;
    espalier::BakeOptions options;
    options.original_ids = true;
    options.flat_angle = 5.0;
    const espalier::BakeResult baked = bake(mesh, options, "blob");
    options = {};
    options.resolution = espalier::Resolution::bits(10);
    options.profile = espalier::Profile::small;
    const espalier::BakeResult coarse = bake(mesh, options, "coarse_blob");
    const espalier::Blob blob = espalier::open(baked.bytes);
    const espalier::Blob coarse_blob = espalier::open(coarse.bytes);
    const Questions questions = {read<espalier::Vec3>("origins"),
                                 read<espalier::Vec3>("directions"),
                                 read<float>("limits"),
                                 read<float>("radii"),
                                 read<espalier::Vec3>("vertices"),
                                 read<std::uint32_t>("vertexOffsets"),
                                 read<espalier::Plane>("planes"),
                                 read<std::uint32_t>("planeOffsets")};
    answer_blob(blob, questions);
    answer_filtered(blob, questions);
    answer_pairs(blob, coarse_blob, questions);
    const std::span<const std::byte> blobs[] = {baked.bytes, coarse.bytes};
    const espalier::SceneBakeResult joined = espalier::bake_scene(blobs, instances_of(questions));
    if (!joined) {
        std::fprintf(stderr, "answers: %s\n", joined.message.c_str());
        return 2;
    }
    write_file("scene", joined.bytes.data(), joined.bytes.size());
    espalier::Blob meshes[2];
    const espalier::BakedScene scene = espalier::open_scene(joined.bytes, meshes);
    answer_scene(scene, questions);
    answer_moving(blob, coarse_blob, scene, questions);
    return 0;
}
