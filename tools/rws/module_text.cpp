#include "tools/rws/module_text.h"

#include "config/atomic_file.h"
#include "config/letter_case.h"
#include "frontend/edit/save_values.h"
#include "frontend/syntax/parser.h"
#include "runtime/host/controller.h"
#include "runtime/value/value_text.h"

#include <algorithm>
#include <filesystem>

namespace rapidc::rws {

namespace {

using rapid::config::sameName;

bool isContinuation(char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

/// Offset of the row's first byte; npos when there is no such row.
std::size_t rowStart(std::string_view text, int64_t row) {
    std::size_t at = 0;
    for (int64_t i = 1; i < row; ++i) {
        at = text.find('\n', at);
        if (at == std::string_view::npos) return at;
        ++at;
    }
    return at;
}

/// End of the row that begins there, without its line end.
std::size_t rowEnd(std::string_view text, std::size_t start) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    return end > start && end < text.size() && text[end - 1] == '\r' ? end - 1 : end;
}

/// After as many characters, at most at `end`.
std::size_t afterCharacters(std::string_view text, std::size_t at, std::size_t end, int64_t characters) {
    for (; characters > 0 && at < end; --characters) {
        ++at;
        while (at < end && isContinuation(text[at]))
            ++at;
    }
    return at;
}

/// The bytes of a range.
std::optional<std::pair<std::size_t, std::size_t>> bytesOf(std::string_view text, const TextRange& range) {
    const std::size_t first = rowStart(text, range.startRow);
    std::size_t last = first;
    if (range.endRow < 0)
        last = text.rfind('\n') == std::string_view::npos ? 0 : text.rfind('\n') + 1;
    else
        last = rowStart(text, range.endRow);
    if (first == std::string_view::npos || last == std::string_view::npos || last < first)
        return std::nullopt;
    const std::size_t lastEnd = rowEnd(text, last);
    const std::size_t begin = afterCharacters(text, first, rowEnd(text, first), range.startColumn - 1);
    const std::size_t end =
        range.endColumn < 0 ? lastEnd : afterCharacters(text, last, lastEnd, range.endColumn);
    if (end < begin) return std::nullopt;
    return std::pair(begin, end);
}

/// The header of a module, read from its text.
const rapid::syntax::ModuleDecl* headerOf(const rapid::syntax::SyntaxTree& tree, std::string_view module) {
    for (const rapid::syntax::ModuleDecl* decl : tree.modules)
        if (sameName(tree.text(decl->name), module)) return decl;
    return nullptr;
}

/// Only the beginning is read, so that long modules cost nothing.
std::unique_ptr<rapid::syntax::SyntaxTree> readHeader(std::string_view text) {
    constexpr std::size_t kMost = 4096; // comments before the header may be long
    rapid::diag::Sink ignored;
    auto source =
        std::make_shared<const rapid::SourceFile>("header.modx", std::string(text.substr(0, kMost)));
    return rapid::syntax::parse(std::move(source), ignored);
}

} // namespace

std::optional<std::string> partOf(std::string_view text, const TextRange& range) {
    const auto bytes = bytesOf(text, range);
    if (!bytes) return std::nullopt;
    return std::string(text.substr(bytes->first, bytes->second - bytes->first));
}

std::optional<std::string> withRange(std::string_view text, const TextRange& range, std::string_view part,
                                     RangeMode mode) {
    const auto bytes = bytesOf(text, range);
    if (!bytes) return std::nullopt;
    auto [begin, end] = *bytes;
    if (mode == RangeMode::After) begin = end;
    if (mode == RangeMode::Before) end = begin;
    return std::string(text.substr(0, begin)).append(part).append(text.substr(end));
}

std::optional<std::string> withInitialValue(const std::string& text, std::string_view module,
                                            std::string_view name, std::string_view value) {
    rapid::diag::Sink ignored;
    const auto tree =
        rapid::syntax::parse(std::make_shared<const rapid::SourceFile>("text.modx", text), ignored);
    const rapid::syntax::ModuleDecl* header = headerOf(*tree, module);
    if (header == nullptr) return std::nullopt;
    for (const rapid::syntax::Decl* decl : header->decls) {
        if (decl->kind != rapid::syntax::NodeKind::Data) continue;
        const auto& data = rapid::syntax::as<rapid::syntax::DataDecl>(*decl);
        if (!sameName(tree->text(data.name), name) || data.init == nullptr) continue;
        const rapid::SourceRange range = tree->range(*data.init);
        const std::string_view whole = tree->source->text();
        return std::string(whole.substr(0, range.begin)).append(value).append(whole.substr(range.end));
    }
    return std::nullopt;
}

std::optional<RoutineOfRow> routineOfRow(const std::string& text, std::string_view module, std::size_t row) {
    using rapid::syntax::RoutineKind;
    rapid::diag::Sink ignored;
    const auto tree =
        rapid::syntax::parse(std::make_shared<const rapid::SourceFile>("text.modx", text), ignored);
    const rapid::syntax::ModuleDecl* header = headerOf(*tree, module);
    if (header == nullptr) return std::nullopt;
    const std::string_view whole = tree->source->text();
    const auto rowAt = [&](std::size_t offset) {
        return 1 + static_cast<std::size_t>(
                       std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
    };
    for (const rapid::syntax::Decl* decl : header->decls) {
        if (decl->kind != rapid::syntax::NodeKind::Routine) continue;
        const auto& routine = rapid::syntax::as<rapid::syntax::RoutineDecl>(*decl);
        const rapid::SourceRange range = tree->range(routine);
        if (row < rowAt(range.begin) || row > rowAt(range.end)) continue;
        const auto type = routine.routineKind == RoutineKind::Func   ? service::SymbolType::Function
                          : routine.routineKind == RoutineKind::Trap ? service::SymbolType::Trap
                                                                     : service::SymbolType::Procedure;
        return RoutineOfRow{std::string(tree->text(routine.name)), type, routine.local,
                            routine.params.size()};
    }
    return std::nullopt;
}

std::vector<std::pair<std::size_t, std::size_t>> placesOf(std::string_view text, std::string_view wanted,
                                                          std::size_t most) {
    std::vector<std::pair<std::size_t, std::size_t>> places;
    std::size_t row = 1, rowBegin = 0, from = 0;
    while (places.size() < most) {
        const std::size_t at = text.find(wanted, from);
        if (at == std::string_view::npos) break;
        for (std::size_t line = text.find('\n', rowBegin); line < at; line = text.find('\n', rowBegin)) {
            ++row;
            rowBegin = line + 1;
        }
        const auto before = text.substr(rowBegin, at - rowBegin);
        const auto characters =
            std::count_if(before.begin(), before.end(), [](char c) { return !isContinuation(c); });
        places.emplace_back(row, static_cast<std::size_t>(characters) + 1);
        from = at + wanted.size();
    }
    return places;
}

std::pair<std::size_t, std::size_t> sizeOf(std::string_view text) {
    std::size_t rows = 0, longest = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = rowEnd(text, at);
        const auto row = text.substr(at, end - at);
        const auto characters =
            std::count_if(row.begin(), row.end(), [](char c) { return !isContinuation(c); });
        longest = std::max(longest, static_cast<std::size_t>(characters));
        ++rows;
        at = text.find('\n', at);
        if (at == std::string_view::npos) break;
        ++at;
    }
    return {rows, longest};
}

std::string attributesOf(std::string_view text, std::string_view module) {
    const auto tree = readHeader(text);
    const rapid::syntax::ModuleDecl* decl = headerOf(*tree, module);
    std::string attributes;
    if (decl == nullptr) return attributes;
    for (const rapid::syntax::TokenIndex token : decl->attributeTokens)
        attributes += (attributes.empty() ? "" : ",") + std::string(tree->text(token));
    return attributes;
}

bool isSystemModule(std::string_view text, std::string_view module) {
    const auto tree = readHeader(text);
    const rapid::syntax::ModuleDecl* decl = headerOf(*tree, module);
    return decl != nullptr && (decl->attributes & rapid::syntax::kAttrSysmodule) != 0;
}

std::string saveModule(rt::Controller& controller, const rt::Task& task, const rt::LoadedModule& module,
                       const std::string& text, const std::string& file) {
    const auto source = std::make_shared<const rapid::SourceFile>(module.name + ".modx", text);
    rapid::diag::Sink ignored; // it is in memory: it has no mistakes
    const auto tree = rapid::syntax::parse(source, ignored);
    std::vector<rapid::edit::DataValue> values;
    const auto index = static_cast<int32_t>(task.index());
    for (const rt::GlobalDesc* data : controller.tables().globals()) {
        std::string value;
        const bool isOwn =
            sameName(data->module, module.name) && controller.tables().isDeclaredIn(*data, index);
        if (isOwn && data->kind == rt::kGlobalPersistent &&
            rt::valueToSource(data->address, *data->type, value))
            values.push_back({data->module, data->name, std::move(value)});
    }
    const rapid::edit::SavedModule saved = rapid::edit::saveValues(*tree, values);
    if (!saved.problem.empty()) return saved.problem;
    return rapid::config::replaceFile(file, saved.bytes);
}

} // namespace rapidc::rws
