#pragma once
// The types and attributes of system parameters (.cfg) that an editor offers and explains: those of RobotWare 6 and 7 that the
// controller reads, each with its values and a line about it.

#include <span>
#include <string_view>

namespace lsp {

struct AttributeWord {
    std::string_view name;
    std::string_view values; ///< separated by blanks; empty: any
    std::string_view help;
    std::string_view
        refersTo; ///< the type that its value names an instance of, "task", "routine"; empty: none
};

struct TypeWord {
    std::string_view domain; ///< "EIO"
    std::string_view name;   ///< "EIO_SIGNAL"
    std::string_view help;
    std::span<const AttributeWord> attributes;
};

std::span<const TypeWord> configurationTypes();
/// Null when it is not known.
const TypeWord* findType(std::string_view name);
const AttributeWord* findAttribute(const TypeWord& type, std::string_view name);

} // namespace lsp
