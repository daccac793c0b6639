#include "specimens/vtk_xml_tags.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace proveta::vtk {

namespace {

constexpr auto nowhere = std::string_view::npos;

[[noreturn]] void refuse(const std::string& why) { throw std::runtime_error("cannot be read (" + why + ")"); }

std::size_t behind(std::string_view text, std::size_t from, std::string_view what) {
    const auto at = text.find(what, from);
    if (at == nowhere) {
        refuse("it ends within a tag");
    }
    return at + what.size();
}

// Takes a tag from its "<", which is at `at`, and leaves that behind its ">".
XmlTag take_tag(std::string_view text, std::size_t& at) {
    XmlTag tag;
    tag.data = behind(text, at, ">");
    std::size_t p = text.find_first_of(" \t\r\n/>", at + 1);
    tag.name = text.substr(at + 1, p == nowhere ? p : p - at - 1);
    while ((p = text.find_first_not_of(" \t\r\n/", p)) != nowhere && text[p] != '>') {
        const auto name_end = text.find_first_of(" \t\r\n=", p);
        const auto open = text.find_first_not_of(" \t\r\n=", name_end);
        if (open == nowhere || (text[open] != '"' && text[open] != '\'')) {
            refuse("an attribute has no value in quotes");
        }
        const auto close = behind(text, open + 1, text.substr(open, 1));
        tag.attributes.emplace_back(text.substr(p, name_end - p), text.substr(open + 1, close - open - 2));
        p = close;
    }
    at = behind(text, std::min(p, text.size()), ">");
    return tag;
}

} // namespace

bool XmlTag::has(std::string_view attribute) const {
    return std::any_of(attributes.begin(), attributes.end(), [&](const auto& a) { return a.first == attribute; });
}

std::string_view XmlTag::value(std::string_view attribute) const {
    const auto found = std::find_if(attributes.begin(), attributes.end(), [&](const auto& a) { return a.first == attribute; });
    return found == attributes.end() ? std::string_view() : found->second;
}

std::vector<XmlTag> xml_tags(std::string_view text) {
    std::vector<XmlTag> out;
    for (auto at = text.find('<'); at != nowhere; at = text.find('<', at)) {
        const auto rest = text.substr(at);
        if (rest.starts_with("<!--")) {
            at = behind(text, at + 4, "-->");
        } else if (rest.starts_with("<?")) {
            at = behind(text, at, "?>");
        } else if (rest.starts_with("<!")) {
            refuse("it has a document type or CDATA");
        } else if (rest.starts_with("</")) {
            at = behind(text, at, ">");
        } else {
            out.push_back(take_tag(text, at));
            if (out.back().name.starts_with("AppendedData")) { // VTK's parser ends with any of these
                break;
            }
        }
    }
    return out;
}

} // namespace proveta::vtk
