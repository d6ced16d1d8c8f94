#include "tools/rws/symbol_text.h"
#include "tools/rws/request_values.h"

#include "config/letter_case.h"
#include "stdlib/impl/data/name_pattern.h"
#include "tools/rws/rapid_support.h"

#include <iterator>

namespace rapidc::rws {

namespace {

using rapid::config::sameName;
using service::SymbolInfo;
using service::SymbolQuery;
using service::SymbolType;

struct TypeText {
    SymbolType type;
    const char* symtyp;
    const char* word; ///< in the class
};
constexpr TypeText kTypes[] = {
    {SymbolType::Task, "tsk", "task"},       {SymbolType::Module, "mod", "mod"},
    {SymbolType::Atomic, "atm", "atomic"},   {SymbolType::Record, "rec", "record"},
    {SymbolType::Alias, "ali", "alias"},     {SymbolType::Component, "rcp", "reccomp"},
    {SymbolType::Constant, "con", "const"},  {SymbolType::Variable, "var", "var"},
    {SymbolType::Persistent, "per", "pers"}, {SymbolType::Parameter, "par", "param"},
    {SymbolType::Procedure, "prc", "proc"},  {SymbolType::Function, "fun", "func"},
    {SymbolType::Trap, "trp", "trap"},
};
/// Further words for them in searches.
constexpr std::pair<const char*, SymbolType> kWords[] = {
    {"const", SymbolType::Constant}, {"pers", SymbolType::Persistent}, {"func", SymbolType::Function},
    {"proc", SymbolType::Procedure}, {"trap", SymbolType::Trap},       {"module", SymbolType::Module},
    {"task", SymbolType::Task},      {"record", SymbolType::Record},   {"alias", SymbolType::Alias},
};

const TypeText& textOf(SymbolType type) {
    for (const TypeText& row : kTypes)
        if (row.type == type) return row;
    return kTypes[0];
}

bool isData(SymbolType type) {
    return type == SymbolType::Constant || type == SymbolType::Variable || type == SymbolType::Persistent;
}

/// Sizes divided by blanks.
std::string dimText(const SymbolInfo& symbol) {
    std::string text;
    for (const int32_t dim : symbol.dims)
        text += (text.empty() ? "" : " ") + std::to_string(dim);
    return text;
}

/// "any" asks for everything. False: the word is unknown.
bool readType(const std::string& word, std::set<SymbolType>& types, bool& any) {
    if (word.empty()) return true;
    if (sameName(word, "any") || sameName(word, "udef")) return any = true;
    for (const TypeText& row : kTypes)
        if (sameName(word, row.symtyp)) return types.insert(row.type), true;
    for (const auto& [known, type] : kWords)
        if (sameName(word, known)) return types.insert(type), true;
    return false;
}

bool readFlag(const Fields& form, const char* name, bool otherwise, bool& into) {
    const std::string text = form.text(name);
    const std::optional<bool> flag = text.empty() ? otherwise : flagIn(text);
    into = flag.value_or(otherwise);
    return flag.has_value();
}

/// The patterns of SetDataSearch, for the whole name. With one anchor only the other end is free.
bool readPattern(std::string text, SymbolQuery& query) {
    if (text.size() > 80) return false;
    const bool fromStart = text.starts_with('^');
    if (fromStart) text.erase(0, 1);
    const bool toEnd = text.ends_with('$');
    if (toEnd) text.pop_back();
    if (text.empty()) return true;
    if (fromStart != toEnd) text = fromStart ? "(" + text + ").*" : ".*(" + text + ")";
    auto pattern = std::make_shared<rt::lib::NamePattern>();
    if (!pattern->parse(text)) return false;
    query.matches = [pattern](const std::string& name) { return pattern->matches(name); };
    return true;
}

bool readTypes(const Fields& form, SymbolQuery& query, std::string& problem) {
    bool any = false;
    for (const auto& [name, value] : form.all()) {
        if (!sameName(name, "symtyp")) continue;
        if (readType(value, query.types, any)) continue;
        problem = "symtyp must be con, var, per, fun, prc, trp, mod, tsk, atm, rec, ali, rcp, par or any";
        return false;
    }
    query.dataType = form.text("dattyp");
    // vartyp names kinds of symbols in some clients, data types in others
    if (const std::string text = form.text("vartyp"); !text.empty()) {
        std::set<SymbolType> types;
        bool all = false;
        if (!readType(text, types, all)) {
            if (query.dataType.empty()) query.dataType = text;
        } else if (query.types.empty() && !any) {
            query.types = types;
        }
    }
    if (any) query.types.clear();
    if (sameName(query.dataType, "any")) query.dataType.clear();
    return true;
}

} // namespace

std::string_view symtypOf(SymbolType type) {
    return textOf(type).symtyp;
}

Entry symbolEntry(const SymbolInfo& symbol, Dialect dialect, const char* suffix) {
    const TypeText& text = textOf(symbol.type);
    Entry entry;
    entry.type = std::string("rap-symprop") + text.word + suffix;
    if (symbol.type == SymbolType::Constant && dialect == Dialect::V2)
        entry.type = std::string("rap-sympropconstant") + suffix;
    entry.title = symbol.url;
    entry.value("symburl", symbol.url).value("name", symbol.name).value("symtyp", text.symtyp);
    entry.value("named", "true").value("linked", "true").value("local", boolText(symbol.isLocal));
    if (!symbol.dataType.empty()) entry.value("dattyp", symbol.dataType).value("typurl", symbol.typeUrl);
    const bool hasDims = isData(symbol.type) || symbol.type == SymbolType::Parameter;
    if (hasDims) entry.value("ndim", std::to_string(symbol.dims.size())).value("dim", dimText(symbol));
    if (isData(symbol.type)) {
        entry.value("rdonly", boolText(symbol.isReadOnly)).value("ro", boolText(symbol.isReadOnly));
        entry.value("heap", "false").value("storage", symbol.isPredefined ? "shared" : "module");
        entry.value("taskvar", boolText(symbol.type == SymbolType::Variable && symbol.isTaskOnly));
        entry.value("taskpers", boolText(symbol.type == SymbolType::Persistent && symbol.isTaskOnly));
    }
    if (symbol.type == SymbolType::Record)
        entry.value("ncom", std::to_string(symbol.count)).value("valtyp", "val");
    if (symbol.type == SymbolType::Atomic) entry.value("size", "0").value("valtyp", "val");
    if (symbol.type == SymbolType::Component)
        entry.value("comnum", std::to_string(symbol.number)).value("ndim", "0");
    if (symbol.type == SymbolType::Procedure || symbol.type == SymbolType::Function)
        entry.value("npar", std::to_string(symbol.count));
    if (symbol.type == SymbolType::Parameter)
        entry.value("parnum", std::to_string(symbol.number)).value("required", boolText(symbol.isRequired));
    if (symbol.type == SymbolType::Module) entry.value("sysmod", boolText(symbol.isSystemModule));
    return entry;
}

std::optional<SymbolQuery> readQuery(const Fields& form, std::string& problem) {
    SymbolQuery query;
    const std::string view = form.text("view");
    if (sameName(view, "scope"))
        query.view = SymbolQuery::View::Scope;
    else if (sameName(view, "stack"))
        query.view = SymbolQuery::View::Stack;
    else if (!view.empty() && !sameName(view, "block"))
        problem = "view must be block, scope or stack";
    query.block = form.text("blockurl");
    if (query.block.starts_with('/')) query.block.erase(0, 1);
    if (query.block.empty() && form.has("task")) query.block = "RAPID/" + form.text("task");
    if (problem.empty() && !readTypes(form, query, problem)) return std::nullopt;
    query.typeUrl = form.text("typurl");
    if (query.typeUrl.starts_with('/')) query.typeUrl.erase(0, 1);
    bool flags = readFlag(form, "recursive", true, query.recursive);
    flags = readFlag(form, "onlyused", false, query.onlyUsed) && flags;
    flags = readFlag(form, "skipshared", false, query.skipPredefined) && flags;
    if (problem.empty() && !flags) problem = "recursive, onlyused and skipshared must be true or false";
    const std::string stack = form.text("stack");
    const auto frame = stack.empty() ? 0 : wholeIn(stack, 0, 10'000);
    if (problem.empty() && !frame) problem = "stack must be the number of a stack frame";
    query.frame = static_cast<uint32_t>(frame.value_or(0));
    if (problem.empty() && !readPattern(form.text("regexp"), query))
        problem = "regexp must be a pattern of at most 80 characters: . [a-z] * + ? | ()";
    return problem.empty() ? std::optional(query) : std::nullopt;
}

} // namespace rapidc::rws
