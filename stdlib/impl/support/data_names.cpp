#include "stdlib/impl/support/data_names.h"

#include "runtime/io/text_util.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

namespace rt::lib {
namespace {

/// Which element of an array, or which component of a record, has the byte at `offset`; `offset` becomes the one within it.
/// Null: none.
const TypeDesc* partAt(const TypeDesc& whole, std::size_t& offset, std::string& name) {
    if (whole.kind == DescKind::Array) {
        const TypeDesc& element = *whole.fields[0];
        name += fmt::format("{{{}}}", offset / element.size); // counted through all dimensions, from 0
        offset %= element.size;
        return &element;
    }
    if (whole.kind != DescKind::Record) return nullptr;
    for (uint32_t i = 0; i < whole.count; ++i) {
        if (offset < whole.offsets[i] || offset >= whole.offsets[i] + whole.fields[i]->size) continue;
        offset -= whole.offsets[i];
        name += fmt::format(".{}", whole.fieldNames[i]);
        return whole.fields[i];
    }
    return nullptr;
}

/// The part of `whole` that the first word of `path` names; the word is taken off. Without data: none.
AnyRef partNamed(AnyRef whole, std::string_view& path) {
    auto* const begin = static_cast<char*>(whole.data);
    const std::size_t end = path.find_first_of(".{", 1);
    const std::string_view word = path.substr(0, end);
    path.remove_prefix(word.size());
    if (word.front() == '{' && whole.type->kind == DescKind::Array) {
        uint32_t index = 0;
        std::from_chars(word.data() + 1, word.data() + word.size(), index);
        const TypeDesc* element = whole.type->fields[0];
        if (index >= whole.type->count) return {};
        return {begin + std::size_t{index} * element->size, element};
    }
    if (word.front() != '.' || whole.type->kind != DescKind::Record) return {};
    for (uint32_t i = 0; i < whole.type->count; ++i)
        if (sameName(whole.type->fieldNames[i], word.substr(1)))
            return {begin + whole.type->offsets[i], whole.type->fields[i]};
    return {};
}

} // namespace

std::string nameOfData(Controller& controller, const void* data, const TypeDesc* type) {
    const auto* at = static_cast<const char*>(data);
    for (const GlobalDesc* row : controller.tables().globals()) {
        const auto* begin = static_cast<const char*>(row->address);
        if (at < begin || at >= begin + row->type->size) continue;
        std::string name = fmt::format("{}:{}", row->module, row->name);
        auto offset = static_cast<std::size_t>(at - begin);
        const TypeDesc* part = row->type;
        while (part != nullptr && (offset != 0 || part != type))
            part = partAt(*part, offset, name);
        if (part != nullptr) return name;
    }
    return {};
}

AnyRef dataByName(const Task& task, const std::string& name) {
    const std::size_t colon = name.find(':');
    if (colon == std::string::npos) return {};
    const std::size_t end = name.find_first_of(".{", colon);
    const GlobalDesc* row =
        task.controller().findGlobal(name.substr(colon + 1, end - colon - 1), name.substr(0, colon), task);
    if (row == nullptr) return {};
    AnyRef data{row->address, row->type};
    std::string_view path = std::string_view(name).substr(std::min(end, name.size()));
    while (data.data != nullptr && !path.empty())
        data = partNamed(data, path);
    return data;
}

} // namespace rt::lib
