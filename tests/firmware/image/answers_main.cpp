// Asks the blob in the image the same questions as the host does, awkward ones among them, and a moving scene of it,
// and prints the same lines.
#include <espalier/espalier.hpp>

#include "../../platform/answers.hpp"
#include "../../platform/moving_answers.hpp"
#include "../../platform/report.hpp"
#include "blob_in_image.hpp"
#include "semihosting.hpp"

int main() {
    using namespace espalier;
    const Blob blob = open(firmware::blob_in_image());
    if (!blob) {
        board::print(describe(blob.status()));
        return 2;
    }
    board::print(platform::report(platform::ask_everything(blob, ESPALIER_QUESTIONS)).c_str());
    board::print(platform::report(platform::ask_moving(blob, 40 * ESPALIER_QUESTIONS)).c_str());
    return 0;
}
