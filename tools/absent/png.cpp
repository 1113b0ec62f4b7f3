// In place of render/png.cpp in a build whose ESPALIER_COMMAND_PARTS has no png.
#include "base/exit_code.hpp"
#include "render/shading.hpp"

namespace espalier::tools {

std::vector<std::byte> Image::png() const {
    throw_error(ExitCode::unsupported,
                "this build writes no pictures, because it has no libpng. Use a build with png.");
}

}  // namespace espalier::tools
