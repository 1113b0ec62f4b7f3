#include "program.hpp"

#include <cstdio>
#include <exception>
#include <stdexcept>

namespace espalier::bench {

Program::Program(const std::string& name, const std::string& description) : CLI::App(description, name) {
    add_option("meshes", meshes_, "What to measure")->required()->type_name("MESH.obj|MESH.ply");
}

int Program::run(int count, char** words, const std::function<void(const std::vector<std::string>&)>& measure) {
    const auto fail = [this](const char* why, int status) {
        std::fprintf(stderr, "%s: %s\n", get_name().c_str(), why);
        if (status == 1) std::fprintf(stderr, "Run '%s --help'.\n", get_name().c_str());
        return status;
    };
    try {
        parse(count, words);
        measure(meshes_);
    } catch (const CLI::Success& success) {
        return exit(success);  // --help
    } catch (const CLI::ParseError& error) {
        return fail(error.what(), 1);
    } catch (const std::invalid_argument& error) {
        return fail(error.what(), 1);
    } catch (const std::exception& error) {
        return fail(error.what(), 2);
    }
    return 0;
}

}  // namespace espalier::bench
