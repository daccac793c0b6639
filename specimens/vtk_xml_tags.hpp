// The tags of VTK's XML files, as its readers see them.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

namespace proveta::vtk {

/// A tag that begins an element.
struct XmlTag {
    std::string_view name;
    std::vector<std::pair<std::string_view, std::string_view>> attributes; ///< names and values
    std::size_t data = 0; ///< behind its first ">", where VTK's readers look for what it holds, even if that stands in an attribute

    [[nodiscard]] bool has(std::string_view attribute) const;
    /// As it is written; "" where there is none.
    [[nodiscard]] std::string_view value(std::string_view attribute) const;
};

/// The tags of a text in their order, up to that of appended data, behind which bytes may stand as they are. Throws std::runtime_error
/// where there are document types or CDATA, in which another reader might see others.
std::vector<XmlTag> xml_tags(std::string_view text);

} // namespace proveta::vtk
