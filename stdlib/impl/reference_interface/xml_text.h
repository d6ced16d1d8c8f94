#pragma once
// XML as a tree of elements: the files and messages of Robot Reference Interface.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rt::lib {

struct XmlElement {
    std::string name;
    std::string text; ///< without blanks around it
    std::vector<std::pair<std::string, std::string>> attributes;
    std::vector<XmlElement> children;

    /// The first child with this name, without regard to case; null when there is none.
    const XmlElement* find(std::string_view child) const;
    /// "" when there is none.
    std::string attribute(std::string_view attributeName) const;
};

/// The root element. Returns why the text cannot be read, for people; "" when it can. Text with elements nested more than 32
/// deep is refused.
std::string readXml(std::string_view text, XmlElement& root);

/// The characters that have a meaning in XML as entities.
std::string escapedXml(std::string_view text);

} // namespace rt::lib
