#include "stdlib/impl/reference_interface/xml_text.h"

#include "runtime/base/text_util.h"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <sstream>

namespace rt::lib {
namespace {

using Tree = boost::property_tree::ptree;

/// The parser calls itself for each element inside of another one.
bool isTooDeep(std::string_view text) {
    constexpr int kDeepest = 32;
    int depth = 0;
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        if (text[i] == '/' && text[i + 1] == '>') --depth;
        if (text[i] != '<') continue;
        if (text[i + 1] == '/')
            --depth;
        else if (text[i + 1] != '!' && text[i + 1] != '?' && ++depth > kDeepest)
            return true;
    }
    return false;
}

XmlElement elementOf(const std::string& name, const Tree& tree) {
    XmlElement element;
    element.name = name;
    element.text = std::string(trimmed(tree.data()));
    for (const auto& [child, content] : tree) {
        if (child == "<xmlcomment>") continue;
        if (child != "<xmlattr>") {
            element.children.push_back(elementOf(child, content));
            continue;
        }
        for (const auto& [attribute, value] : content)
            element.attributes.emplace_back(attribute, value.data());
    }
    return element;
}

} // namespace

const XmlElement* XmlElement::find(std::string_view child) const {
    for (const XmlElement& element : children)
        if (sameName(element.name, child)) return &element;
    return nullptr;
}

std::string XmlElement::attribute(std::string_view attributeName) const {
    for (const auto& [other, value] : attributes)
        if (sameName(other, attributeName)) return value;
    return {};
}

std::string readXml(std::string_view text, XmlElement& root) {
    if (isTooDeep(text)) return "its elements are nested more than 32 deep";
    Tree tree;
    std::istringstream in{std::string(text)};
    try {
        boost::property_tree::read_xml(in, tree, boost::property_tree::xml_parser::no_comments);
    } catch (const boost::property_tree::xml_parser_error& error) {
        return "it is not XML: " + error.message() + " in line " + std::to_string(error.line());
    }
    if (tree.empty()) return "it has no element";
    root = elementOf(tree.front().first, tree.front().second);
    return {};
}

std::string escapedXml(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
        case '<': out += "&lt;"; break;
        case '>': out += "&gt;"; break;
        case '&': out += "&amp;"; break;
        case '"': out += "&quot;"; break;
        default: out += c;
        }
    }
    return out;
}

} // namespace rt::lib
