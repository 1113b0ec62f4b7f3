// Contacts of bodies with one blob.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "held_blob.hpp"
#include "lists.hpp"
#include "shape_batches.hpp"

#include <espalier/contact.hpp>

namespace espalier::python {

namespace {

/// Returns (offsets, contacts, statuses).
py::tuple contact_lists(const HeldBlob& self, const std::string& kind, const py::tuple& given, const py::handle& margin,
                        std::size_t most, unsigned threads) {
    Floats margins(margin, "margin", {});
    return list_for_shapes<Contact>(
        kind, given, &margins, dtype_of("contact"), threads,
        [&](const auto& shape, std::size_t i, Growing<Contact>& contacts) requires requires {
            find_contacts(self.blob, shape, 0.0f, std::span<Contact>());
        } {
            const Filled filled =
                find_contacts(self.blob, shape, margins.as<float>().at(i), contacts.places(most).first(most));
            contacts.add(filled.count);
            return filled.status;
        });
}

}  // namespace

void bind_contacts(py::module_& module) { module.def("contact_lists", contact_lists); }

}  // namespace espalier::python
