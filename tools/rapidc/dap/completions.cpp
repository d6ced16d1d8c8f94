// Completions in the console: data, signals, routines and words whose names begin as the text does; components after a point.

#include "tools/rapidc/dap/inspection_requests.h"

#include "runtime/base/text_util.h"
#include "stdlib/native_table.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <set>

namespace rapidc::dap {

namespace {

constexpr std::size_t kMostItems = 500;

bool isPartOfName(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ||
           static_cast<unsigned char>(c) >= 0x80;
}

bool beginsWith(std::string_view name, std::string_view prefix) {
    return name.size() >= prefix.size() && rt::sameName(name.substr(0, prefix.size()), prefix);
}

/// Collects items, each name once.
class Items {
  public:
    Items(std::string prefix, std::size_t start) : prefix_(std::move(prefix)), start_(start) {}
    void add(const std::string& name, const char* type, const std::string& detail = "") {
        if (!beginsWith(name, prefix_) || list_.size() >= kMostItems ||
            !known_.insert(rt::upperCase(name)).second)
            return;
        Json item{{"label", name}, {"type", type}, {"start", start_}, {"length", prefix_.size()}};
        if (!detail.empty()) item["detail"] = detail;
        list_.push_back(std::move(item));
    }
    Json take() { return {{"targets", std::move(list_)}}; }

  private:
    std::string prefix_;
    std::size_t start_;
    std::set<std::string> known_;
    Json list_ = Json::array();
};

/// The reference in front of the point at `end`: "list{2}.pos".
std::string pathBefore(std::string_view text, std::size_t end) {
    std::size_t begin = end;
    while (begin > 0) {
        const char c = text[begin - 1];
        if (c == '}') {
            const std::size_t open = text.rfind('{', begin - 1);
            if (open == std::string_view::npos) break;
            begin = open;
        } else if (isPartOfName(c) || c == '.') {
            --begin;
        } else {
            break;
        }
    }
    return std::string(text.substr(begin, end - begin));
}

} // namespace

Json completionsFor(Context& context, const Site& site, const std::string& text, std::size_t column,
                    const std::vector<rt::DebugVariable>& data) {
    // Columns count UTF-16 units; names of RAPID are ISO 8859-1, so that a character is one unit.
    std::size_t end = 0;
    for (std::size_t units = 0; end < text.size() && units < column; ++units)
        do
            ++end;
        while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80);
    std::size_t begin = end;
    while (begin > 0 && isPartOfName(text[begin - 1]))
        --begin;
    const std::size_t start = column - std::min(column, end - begin);
    Items items(text.substr(begin, end - begin), start + (context.facts.columnsStartAt1 ? 1 : 0));
    if (begin > 0 && text[begin - 1] == '.') {
        const Evaluation found = context.evaluator->find(site, pathBefore(text, begin - 1));
        if (found.hasValue && found.value.rank == 0 && found.value.type->kind == rt::DescKind::Record)
            for (uint32_t i = 0; i < found.value.type->count; ++i)
                items.add(found.value.type->fieldNames[i], "property", found.value.type->fields[i]->name);
        return items.take();
    }
    for (const rt::DebugVariable& variable : data)
        items.add(variable.name, "variable", rt::typeName(variable));
    const rt::IoSystem& io = context.controller().io();
    for (std::size_t i = 0; i < io.size(); ++i) {
        const rt::SignalConfig& signal = io.config(static_cast<rt::SignalId>(i));
        items.add(signal.name, "variable", rt::signalTypeName(signal.type));
    }
    for (const rt::RoutineEntry* entry : context.controller().tables().routines()) {
        const bool function = entry->kind == rt::kRoutineFunc;
        if (entry->kind != rt::kRoutineTrap && entry->desc->isBuiltin == 0)
            items.add(entry->name, function ? "function" : "method", entry->module);
    }
    if (end > begin)
        for (const rt::NativeEntry& entry : rt::nativeTable())
            items.add(std::string(entry.name), "function");
    for (const char* word :
         {"AND", "DIV", "FALSE", "FOR", "IF", "MOD", "NOT", "OR", "RETURN", "TEST", "TRUE", "WHILE", "XOR"})
        items.add(word, "keyword");
    return items.take();
}

} // namespace rapidc::dap
