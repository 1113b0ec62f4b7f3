// XML, element by element: nothing of a text is kept that its handler does not keep.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace espalier::importer {

/// An element as it begins. Valid while it is handled.
class XmlElement {
public:
    /// `name` and the attributes are expat's: "namespace|name", and names and values in turn up to a null.
    XmlElement(const char* name, const char** attributes, std::uint64_t line);

    [[nodiscard]] std::string_view name_space() const { return space_; }
    [[nodiscard]] std::string_view name() const { return name_; }
    [[nodiscard]] std::uint64_t line() const { return line_; }
    /// Returns the value of an attribute without a namespace, or of one of a namespace that contains `part`.
    [[nodiscard]] std::optional<std::string_view> attribute(std::string_view name) const;
    [[nodiscard]] std::optional<std::string_view> attribute_of(std::string_view part, std::string_view name) const;

private:
    std::string_view space_;
    std::string_view name_;
    const char** attributes_;
    std::uint64_t line_;
};

/// What is called with the elements of a text, in its order. It may throw.
class XmlHandler {
public:
    virtual ~XmlHandler() = default;
    /// A prefix that stands for a namespace from the next element on.
    virtual void name_space(std::string_view, std::string_view) {}
    virtual void begin(const XmlElement& element) = 0;
    virtual void end() {}
};

/// Throws what the handler throws, and ImportError (invalid_input) for a text that is not well-formed, or defines
/// entities, which could grow without bound. `words` name the text in messages.
void parse_xml(const std::string& words, std::string_view xml, XmlHandler& handler);

}  // namespace espalier::importer
