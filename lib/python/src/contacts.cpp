// Contacts of bodies with one blob.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "held_blob.hpp"
#include "lists.hpp"
#include "shapes.hpp"

#include <espalier/contact.hpp>

namespace espalier::python {

namespace {

/// Returns (offsets, contacts, statuses).
py::tuple contact_lists(const HeldBlob& self, const std::string& kind, const py::tuple& given, const py::handle& margin,
                        std::size_t most, unsigned threads) {
    if (kind != "Sphere" && kind != "Capsule" && kind != "OrientedBox") refuse_shape(kind);
    ShapeFields fields;
    return with_shape(kind, given, fields, [&](const auto& at) -> py::tuple {
        Floats margins(margin, "margin", {});
        const Batch batch = spread(fields, &margins);
        const auto width = margins.as<float>();
        return make_lists<Contact>(batch, dtype_of("contact"), threads, [&](std::size_t i, Growing<Contact>& contacts) {
            return at(i, [&](const auto& shape) {
                if constexpr (requires { find_contacts(self.blob, shape, 0.0f, std::span<Contact>()); }) {
                    const Filled filled =
                        find_contacts(self.blob, shape, width.at(i), contacts.places(most).first(most));
                    contacts.add(filled.count);
                    return filled.status;
                } else {
                    return QueryStatus::invalid_argument;
                }
            });
        });
    });
}

}  // namespace

void bind_contacts(py::module_& module) { module.def("contact_lists", contact_lists); }

}  // namespace espalier::python
