// answers FOLDER: bakes FOLDER/positions and FOLDER/triangles twice, writes FOLDER/blob, FOLDER/coarse_blob and
// FOLDER/scene, and queries them with the arrays of float32 FOLDER/origins, directions, limits, radii, vertices and
// planes, and those of uint32 FOLDER/vertexOffsets and planeOffsets. Writes the answers of each query to a file of its
// name, as words in the order of the fields. Each comes from one call of C++ for each question.
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <espalier/scenes/bake.hpp>

#include "questions.hpp"
#include "words.hpp"

namespace espalier::answers {

namespace {

/// Reads and writes files of a folder.
class Folder {
public:
    explicit Folder(const char* path) : path_(std::string(path) + "/") {}

    template <class Element>
    [[nodiscard]] std::vector<Element> read(const char* name) const {
        std::ifstream file(path_ + name, std::ios::binary);
        const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
        std::vector<Element> elements(bytes.size() / sizeof(Element));
        std::memcpy(elements.data(), bytes.data(), sizeof(Element) * elements.size());
        return elements;
    }
    void write(const std::string& name, std::span<const std::byte> bytes) const {
        std::ofstream(path_ + name, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
    template <class Baked>
    [[nodiscard]] std::vector<std::byte> write_baked(const std::string& name, Baked baked) const {
        if (!baked) throw std::runtime_error(baked.message);
        write(name, baked.bytes);
        return std::move(baked.bytes);
    }

private:
    std::string path_;
};

void answer_all(const Folder& folder) {
    const auto positions = folder.read<Vec3>("positions");
    const auto triangles = folder.read<TriangleVertices>("triangles");
    MeshView mesh;
    mesh.positions = positions;
    mesh.triangles = triangles;
    const auto baked = folder.write_baked("blob", bake(std::span(&mesh, 1), {.original_ids = true, .flat_angle = 5.0}));
    const auto coarse = folder.write_baked(
        "coarse_blob", bake(std::span(&mesh, 1), {.resolution = Resolution::bits(10), .profile = Profile::small}));
    const Blob blob = open(baked), coarse_blob = open(coarse);
    const Questions questions = {folder.read<Vec3>("origins"),  folder.read<Vec3>("directions"),
                                 folder.read<float>("limits"),  folder.read<float>("radii"),
                                 folder.read<Vec3>("vertices"), folder.read<std::uint32_t>("vertexOffsets"),
                                 folder.read<Plane>("planes"),  folder.read<std::uint32_t>("planeOffsets")};
    answer_blob(blob, questions);
    answer_pairs(blob, coarse_blob, questions);
    const std::span<const std::byte> blobs[] = {baked, coarse};
    const auto joined = folder.write_baked("scene", bake_scene(blobs, instances_of(questions)));
    Blob meshes[2];
    const BakedScene scene = open_scene(joined, meshes);
    answer_scene(scene, questions);
    folder.write("moving_scene", answer_moving(blob, coarse_blob, scene, questions));
    for (const auto& [name, answers] : words) folder.write(name, answers.bytes());
}

}  // namespace

}  // namespace espalier::answers

int main(int argument_count, char** arguments) {
    if (argument_count != 2) {
        std::fputs("usage: answers FOLDER\n", stderr);
        return 1;
    }
    try {
        espalier::answers::answer_all(espalier::answers::Folder(arguments[1]));
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "answers: %s\n", error.what());
        return 2;
    }
}
