// Attributes of library declarations: the `!@ key: value   key: value` and `!!` comments above them.

#include "frontend/sema/analysis.h"

#include <algorithm>

namespace rapid::sema {

using namespace syntax;

namespace {

bool isKeyChar(char c) {
    return c >= 'a' && c <= 'z';
}

std::string_view trim(std::string_view s) {
    while (!s.empty() && (s.front() == ' ' || s.front() == '\t' || s.front() == '\r'))
        s.remove_prefix(1);
    while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r'))
        s.remove_suffix(1);
    return s;
}

/// Start of the next `key:` at or after `from`; npos if there is none.
size_t findKey(std::string_view line, size_t from) {
    for (size_t i = from; i < line.size(); ++i) {
        if (!isKeyChar(line[i]) || (i > 0 && line[i - 1] != ' ')) continue;
        size_t end = i;
        while (end < line.size() && isKeyChar(line[end]))
            ++end;
        if (end < line.size() && line[end] == ':') return i;
    }
    return std::string_view::npos;
}

template <class F> void forEachLine(std::string_view gap, F&& visit) {
    while (!gap.empty()) {
        const size_t end = gap.find('\n');
        visit(trim(gap.substr(0, end)));
        if (end == std::string_view::npos) return;
        gap.remove_prefix(end + 1);
    }
}

/// Calls visit(key, value) for each attribute in the comments between two declarations.
template <class F> void forEachAttribute(std::string_view gap, F&& visit) {
    forEachLine(gap, [&](std::string_view line) {
        if (!line.starts_with("!@")) return;
        for (size_t key = findKey(line, 2); key != std::string_view::npos;) {
            const size_t colon = line.find(':', key);
            const size_t next = findKey(line, colon);
            const std::string_view value = trim(line.substr(
                colon + 1, next == std::string_view::npos ? std::string_view::npos : next - colon - 1));
            visit(line.substr(key, colon - key), value);
            key = next;
        }
    });
}

/// The white space and comments in front of a declaration.
std::string_view leadingComments(const SyntaxTree& tree, const Node& decl) {
    if (decl.first == kNoToken || decl.first == 0) return {};
    const uint32_t begin = tree.range(decl.first - 1).end;
    return tree.source->text().substr(begin, tree.range(decl.first).begin - begin);
}

Effects effectsOf(std::string_view word) {
    if (word == "const") return Effects::Const;
    if (word == "pure") return Effects::Pure;
    if (word == "reads") return Effects::Reads;
    if (word == "writes") return Effects::Writes;
    if (word == "watches") return Effects::Watches;
    if (word == "waits") return Effects::Waits;
    if (word == "motion") return Effects::Motion;
    return Effects::None;
}

Flow flowOf(std::string_view word) {
    if (word == "leaves") return Flow::Leaves;
    if (word == "raises") return Flow::Raises;
    if (word == "retries") return Flow::Retries;
    if (word == "stops") return Flow::Stops;
    return Flow::GoesOn;
}

uint8_t lintTraitOf(std::string_view word) {
    if (word == "stoppoint") return kLintStopPoint;
    if (word == "names") return kLintNames;
    if (word == "calls") return kLintCalls;
    if (word == "unconnected") return kLintUnconnected;
    return 0;
}

ParamClass classOf(std::string_view words) {
    if (words == "value") return ParamClass::Value;
    if (words == "value or signal") return ParamClass::ValueOrSignal;
    if (words == "atomic") return ParamClass::Atomic;
    if (words == "numeric") return ParamClass::Numeric;
    if (words == "signal") return ParamClass::Signal;
    if (words == "signal or string") return ParamClass::SignalOrString;
    if (words == "array") return ParamClass::Array;
    return ParamClass::Any;
}

} // namespace

void Analyzer::applyTypeAttributes(TypeSymbol& symbol) {
    Type& type = *symbol.type;
    forEachAttribute(leadingComments(*context_.tree, *symbol.decl),
                     [&](std::string_view key, std::string_view value) {
                         if (key != "class") return;
                         if (value.starts_with("nonvalue")) type.kind = TypeKind::NonValue;
                         if (value.starts_with("semivalue")) type.kind = TypeKind::SemiValue;
                         if (value.starts_with("pseudo")) type.kind = TypeKind::AnyType;
                     });
}

void Analyzer::applyDataAttributes(DataSymbol& symbol) {
    forEachAttribute(leadingComments(*context_.tree, *symbol.decl),
                     [&](std::string_view key, std::string_view value) {
                         if (key == "class" && value.starts_with("sysvar"))
                             symbol.storage = Storage::SystemVariable;
                     });
}

void Analyzer::applyRoutineAttributes(RoutineSymbol& symbol) {
    const std::string_view gap = leadingComments(*context_.tree, *symbol.decl);
    const auto findParam = [&](std::string_view name) -> DataSymbol* {
        for (DataSymbol* p : symbol.params)
            if (p->name == name) return p;
        return nullptr;
    };
    forEachLine(gap, [&](std::string_view line) {
        if (!line.starts_with("!!")) return;
        if (!symbol.documentation.empty()) symbol.documentation += '\n';
        symbol.documentation += trim(line.substr(2));
    });
    forEachAttribute(gap, [&](std::string_view key, std::string_view value) {
        if (key == "effects")
            symbol.effects = effectsOf(value.substr(0, value.find(' ')));
        else if (key == "lower")
            symbol.special = value == "special";
        else if (key == "manual")
            symbol.manual = std::string(value.substr(0, value.find(' ')));
        else if (key == "option")
            symbol.option = std::string(value);
        else if (key == "raises") {
            symbol.raises = true;
            symbol.raisedErrors = std::string(value);
        } else if (key == "confidence")
            symbol.uncertain = value != "high";
        else if (key == "flow")
            symbol.flow = flowOf(value);
        else if (key == "lint")
            symbol.lintTraits = lintTraitOf(value);
        else if (key == "length") {
            symbol.textLengthParam = findParam(value);
            for (const char c : value)
                if (c >= '0' && c <= '9')
                    symbol.textLength = static_cast<uint8_t>(symbol.textLength * 10 + (c - '0'));
        } else if (key == "deferred") {
            if (DataSymbol* param = findParam(value)) param->deferred = true;
        } else if (key == "where") { // "Signal is signal, Data is value"
            while (!value.empty()) {
                const size_t comma = std::min(value.find(','), value.size());
                const std::string_view one = trim(value.substr(0, comma));
                value.remove_prefix(std::min(comma + 1, value.size()));
                const size_t is = one.find(" is ");
                DataSymbol* param = is == std::string_view::npos ? nullptr : findParam(one.substr(0, is));
                if (param) param->accepts = classOf(trim(one.substr(is + 4)));
            }
        }
    });
}

} // namespace rapid::sema
