#include <import/3mf/xml.hpp>

#include <algorithm>
#include <exception>
#include <memory>
#include <new>

#include <expat.h>

#include <import/base/error.hpp>

namespace espalier::importer {

namespace {

constexpr char separator = '|';
constexpr std::size_t step_bytes = std::size_t{1} << 20;

/// expat is C: an exception must not pass through it.
struct Parse {
    XML_Parser parser;
    XmlHandler& handler;
    std::exception_ptr thrown = {};
    bool has_document_type = false;

    template <class Call>
    void guard(const Call& call) {
        if (thrown) return;  // expat finishes what it is at
        try {
            call();
        } catch (...) {
            thrown = std::current_exception();
            XML_StopParser(parser, XML_FALSE);
        }
    }
};

void begin_element(void* data, const char* name, const char** attributes) {
    auto& parse = *static_cast<Parse*>(data);
    parse.guard([&] { parse.handler.begin({name, attributes, XML_GetCurrentLineNumber(parse.parser)}); });
}

void end_element(void* data, const char*) {
    auto& parse = *static_cast<Parse*>(data);
    parse.guard([&] { parse.handler.end(); });
}

void begin_name_space(void* data, const char* prefix, const char* name) {
    auto& parse = *static_cast<Parse*>(data);
    parse.guard([&] { parse.handler.name_space(prefix == nullptr ? "" : prefix, name == nullptr ? "" : name); });
}

void begin_document_type(void* data, const char*, const char*, const char*, int) {
    auto& parse = *static_cast<Parse*>(data);
    parse.has_document_type = true;
    XML_StopParser(parse.parser, XML_FALSE);
}

}  // namespace

XmlElement::XmlElement(const char* name, const char** attributes, std::uint64_t line)
    : name_(name), attributes_(attributes), line_(line) {
    const std::size_t at = name_.rfind(separator);
    if (at == std::string_view::npos) return;
    space_ = name_.substr(0, at);
    name_.remove_prefix(at + 1);
}

std::optional<std::string_view> XmlElement::attribute(std::string_view name) const {
    for (const char** attribute = attributes_; *attribute != nullptr; attribute += 2)
        if (name == *attribute) return attribute[1];
    return std::nullopt;
}

std::optional<std::string_view> XmlElement::attribute_of(std::string_view part, std::string_view name) const {
    for (const char** attribute = attributes_; *attribute != nullptr; attribute += 2) {
        const std::string_view full = *attribute;
        const std::size_t at = full.rfind(separator);
        if (at == std::string_view::npos || full.substr(at + 1) != name) continue;
        if (full.substr(0, at).find(part) != std::string_view::npos) return attribute[1];
    }
    return std::nullopt;
}

void parse_xml(const std::string& words, std::string_view xml, XmlHandler& handler) {
    const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(XML_ParserCreateNS(nullptr, separator),
                                                                         XML_ParserFree);
    if (parser == nullptr) throw std::bad_alloc();
    Parse parse{parser.get(), handler};
    XML_SetUserData(parser.get(), &parse);
    XML_SetElementHandler(parser.get(), begin_element, end_element);
    XML_SetStartNamespaceDeclHandler(parser.get(), begin_name_space);
    XML_SetStartDoctypeDeclHandler(parser.get(), begin_document_type);
    XML_Status status = XML_STATUS_OK;
    do {
        const std::string_view step = xml.substr(0, step_bytes);
        xml.remove_prefix(step.size());
        status = XML_Parse(parser.get(), step.data(), static_cast<int>(step.size()), xml.empty() ? 1 : 0);
    } while (status == XML_STATUS_OK && !xml.empty());
    if (parse.thrown) std::rethrow_exception(parse.thrown);
    if (parse.has_document_type)
        throw_error(ImportStatus::invalid_input, words,
                    " has a document type, which its format forbids. Export it again.");
    if (status == XML_STATUS_OK) return;
    if (XML_GetErrorCode(parser.get()) == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
    throw_error(ImportStatus::invalid_input, words, ", line ", std::uint64_t{XML_GetCurrentLineNumber(parser.get())},
                ": its XML is broken: ", XML_ErrorString(XML_GetErrorCode(parser.get())), ". Export it again.");
}

}  // namespace espalier::importer
