#include "runtime/debug/debug_data.h"

#include "runtime/base/text_util.h"
#include "runtime/value/value_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <vector>

namespace rt {
namespace {

/// Rank and dimensions wherever they are written down.
uint8_t dimensions(const DebugVariable& variable, int32_t (&dims)[3]) {
    if (variable.rank > 0) {
        std::memcpy(dims, variable.dims, sizeof dims);
        return variable.rank;
    }
    uint8_t rank = 0;
    if (variable.type->kind == DescKind::Array) {
        std::memcpy(dims, variable.type->dims, sizeof dims);
        while (rank < 3 && dims[rank] > 0)
            ++rank;
    }
    return rank;
}

const TypeDesc& elementType(const DebugVariable& variable) {
    return variable.type->kind == DescKind::Array ? *variable.type->fields[0] : *variable.type;
}

std::string arrayText(const char* data, const TypeDesc& element, const int32_t* dims, uint8_t rank,
                      uint32_t& budget) {
    std::string out = "[";
    std::size_t size = element.size;
    for (uint8_t k = 1; k < rank; ++k)
        size *= static_cast<std::size_t>(dims[k]);
    for (int32_t i = 0; i < dims[0]; ++i) {
        if (i > 0) out += ',';
        if (budget == 0) return out + "...]";
        const char* at = data + static_cast<std::size_t>(i) * size;
        if (rank > 1) {
            out += arrayText(at, element, dims + 1, static_cast<uint8_t>(rank - 1), budget);
        } else {
            out += valueToText(at, element);
            --budget;
        }
    }
    return out + "]";
}

/// Reads "{2,3}" at the front of `path`.
bool readIndices(std::string_view& path, std::vector<int32_t>& indices) {
    const std::size_t end = path.find('}');
    if (end == std::string_view::npos) return false;
    std::string_view list = path.substr(1, end - 1);
    path.remove_prefix(end + 1);
    while (true) {
        const std::size_t comma = std::min(list.find(','), list.size());
        const std::string_view one = trimmed(list.substr(0, comma));
        int32_t index = 0;
        const auto [stop, problem] = std::from_chars(one.data(), one.data() + one.size(), index);
        if (problem != std::errc() || stop != one.data() + one.size()) return false;
        indices.push_back(index);
        if (comma == list.size()) return true;
        list.remove_prefix(comma + 1);
    }
}

DebugVariable elementOf(const DebugVariable& variable, std::string_view& path, std::string& error) {
    std::vector<int32_t> indices;
    int32_t dims[3] = {0, 0, 0};
    const uint8_t rank = dimensions(variable, dims);
    if (!readIndices(path, indices)) {
        error = "indices are whole numbers in braces: {1} or {2,3}";
    } else if (rank == 0) {
        error = fmt::format("'{}' is not an array", variable.name);
    } else if (indices.size() != rank) {
        error =
            fmt::format("'{}' has {} dimensions, {} indices are given", variable.name, rank, indices.size());
    }
    if (!error.empty()) return {};
    std::size_t flat = 0;
    std::string name = variable.name + "{";
    for (uint8_t k = 0; k < rank; ++k) {
        if (indices[k] < 1 || indices[k] > dims[k]) {
            error = fmt::format("index {} of '{}' is outside 1 to {}", indices[k], variable.name, dims[k]);
            return {};
        }
        flat = flat * static_cast<std::size_t>(dims[k]) + static_cast<std::size_t>(indices[k] - 1);
        name += fmt::format("{}{}", k > 0 ? "," : "", indices[k]);
    }
    DebugVariable part = variable;
    part.name = name + "}";
    part.rank = 0;
    part.type = &elementType(variable);
    part.data = static_cast<char*>(variable.data) + flat * part.type->size;
    return part;
}

DebugVariable componentOf(const DebugVariable& variable, std::string_view& path, std::string& error) {
    path.remove_prefix(1);
    const std::size_t end = std::min(path.find_first_of(".{"), path.size());
    const std::string_view name = trimmed(path.substr(0, end));
    path.remove_prefix(end);
    const TypeDesc& type = *variable.type;
    if (variable.rank == 0 && type.kind == DescKind::Record) {
        for (uint32_t i = 0; i < type.count; ++i) {
            if (!sameName(type.fieldNames[i], name)) continue;
            DebugVariable part = variable;
            part.name = fmt::format("{}.{}", variable.name, type.fieldNames[i]);
            part.type = type.fields[i];
            part.data = static_cast<char*>(variable.data) + type.offsets[i];
            return part;
        }
    }
    error = fmt::format("'{}' of type {} has no component '{}'", variable.name, typeName(variable), name);
    return {};
}

/// "<rawbytes, 3 bytes: 61 62 63>"; the first 16 of many.
std::string bytesText(const void* data, const TypeDesc& type) {
    constexpr uint32_t kShown = 16;
    uint32_t length = 0;
    std::memcpy(&length, data, sizeof length);
    length = std::min(length, static_cast<uint32_t>(type.size - sizeof length));
    std::string text = fmt::format("<{}, {} bytes", type.name, length);
    const auto* bytes = static_cast<const unsigned char*>(data) + sizeof length;
    for (uint32_t i = 0; i < std::min(length, kShown); ++i)
        text += fmt::format("{}{:02X}", i == 0 ? ": " : " ", bytes[i]);
    return text + (length > kShown ? " ...>" : ">");
}

/// Data without a value in the language.
bool hasNoText(const TypeDesc& type) {
    return type.kind == DescKind::Handle || type.kind == DescKind::Bytes || type.kind == DescKind::Other;
}

} // namespace

std::string typeName(const DebugVariable& variable) {
    int32_t dims[3] = {0, 0, 0};
    const uint8_t rank = dimensions(variable, dims);
    std::string text = elementType(variable).name;
    for (uint8_t k = 0; k < rank; ++k)
        text += fmt::format("{}{}", k == 0 ? '{' : ',', dims[k]);
    return rank > 0 ? text + "}" : text;
}

std::string valueText(const DebugVariable& variable, uint32_t maxElements) {
    if (variable.data == nullptr) return "<not present>";
    const TypeDesc& element = elementType(variable);
    if (element.kind == DescKind::Bytes && variable.rank == 0 && variable.type->kind != DescKind::Array)
        return bytesText(variable.data, element);
    if (hasNoText(element)) return fmt::format("<{}>", element.name);
    int32_t dims[3] = {0, 0, 0};
    const uint8_t rank = dimensions(variable, dims);
    if (rank == 0) return valueToText(variable.data, element);
    uint32_t budget = maxElements;
    return arrayText(static_cast<const char*>(variable.data), element, dims, rank, budget);
}

DebugVariable partOf(const DebugVariable& variable, std::string_view path, std::string& error) {
    DebugVariable part = variable;
    path = trimmed(path);
    while (!path.empty() && error.empty()) {
        if (part.data == nullptr) {
            error = fmt::format("parameter '{}' is not present", variable.name);
        } else if (path.front() == '{') {
            part = elementOf(part, path, error);
        } else if (path.front() == '.') {
            part = componentOf(part, path, error);
        } else {
            error = fmt::format("found '{}', expected '{{' or '.'", path.front());
        }
    }
    return error.empty() ? part : DebugVariable{};
}

std::string rangeProblem(const void* data, const TypeDesc& type) {
    const auto* bytes = static_cast<const char*>(data);
    std::string problem;
    if (type.kind == DescKind::Num && sameName(type.name, "byte")) {
        float number = 0;
        std::memcpy(&number, bytes, sizeof number);
        if (!(number >= 0 && number <= 255 && std::trunc(number) == number))
            problem = fmt::format("{} is not a byte: give a whole number from 0 to 255", formatNum(number));
    } else if (type.kind == DescKind::Record) {
        for (uint32_t i = 0; i < type.count && problem.empty(); ++i)
            problem = rangeProblem(bytes + type.offsets[i], *type.fields[i]);
    } else if (type.kind == DescKind::Array) {
        for (uint32_t i = 0; i < type.count && problem.empty(); ++i)
            problem = rangeProblem(bytes + std::size_t{i} * type.fields[0]->size, *type.fields[0]);
    }
    return problem;
}

std::string writeText(std::string_view text, void* data, const TypeDesc& type, const std::string& shownType) {
    const auto* const before = static_cast<const char*>(data);
    std::vector<char> value(before, before + type.size);
    if (!textToValue(text, value.data(), type))
        return fmt::format("'{}' is not a value of type {}", text, shownType);
    std::string problem = rangeProblem(value.data(), type);
    if (problem.empty()) std::memcpy(data, value.data(), value.size());
    return problem;
}

std::string assignText(const DebugVariable& variable, std::string_view text) {
    if (variable.data == nullptr) return fmt::format("parameter '{}' is not present", variable.name);
    if (variable.isConstant) return fmt::format("'{}' is a constant", variable.name);
    if (variable.rank > 0 || variable.type->kind == DescKind::Array)
        return fmt::format("'{}' is an array: change its elements one by one", variable.name);
    if (hasNoText(*variable.type))
        return fmt::format("data of type {} cannot be assigned", typeName(variable));
    return writeText(text, variable.data, *variable.type, typeName(variable));
}

} // namespace rt
