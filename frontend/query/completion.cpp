#include "frontend/query/completion.h"

#include "config/letter_case.h"
#include "frontend/query/completion_rules.h"
#include "frontend/query/completion_snippets.h"
#include "frontend/query/describe.h"
#include "frontend/query/edit_places.h"
#include "frontend/query/fuzzy.h"
#include "frontend/query/item_key.h"
#include "frontend/query/optional_names.h"
#include "frontend/sema/names.h"
#include "frontend/syntax/token_set.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

/// First letters of sort texts: what is nearer and fits better comes first. Names that do not begin with the letters typed come after all
/// that do (Completer::ranked).
enum Rank : char {
    kTyped = '/', ///< exactly what has been typed
    kBest = '0',
    kLocal = '1',
    kModule = '2',
    kTask = '3',
    kUsed = '4', ///< predefined routines that the program calls somewhere
    kLibrary = '5',
    kLoose = '6',
    kOther = '7',
    kRare = '9'
};

ItemKind kindOf(const Symbol& symbol) {
    if (const RoutineSymbol* routine = routineOf(&symbol))
        return routine->routineKind == RoutineKind::Func   ? ItemKind::Function
               : routine->routineKind == RoutineKind::Trap ? ItemKind::Trap
                                                           : ItemKind::Procedure;
    if (symbol.kind == SymbolKind::Type) return ItemKind::Type;
    if (symbol.kind == SymbolKind::Label) return ItemKind::Label;
    const DataSymbol* data = dataOf(&symbol);
    if (!data) return ItemKind::Module;
    if (data->storage == Storage::Signal) return ItemKind::Signal;
    if (data->storage == Storage::Parameter) return ItemKind::Parameter;
    if (data->dataKind == DataKind::Const) return ItemKind::Constant;
    return data->dataKind == DataKind::Pers ? ItemKind::Persistent : ItemKind::Variable;
}

class Completer {
  public:
    Completer(const Snapshot& snapshot, const FileView& file, uint32_t offset,
              const CompletionOptions& options, const Cancel* cancel)
        : snapshot_(snapshot), file_(file), offset_(offset), options_(options), cancel_(cancel),
          scope_(snapshot, file, offset), cursor_(cursorAt(scope_, offset)) {}

    CompletionList run() {
        list_.replace = {cursor_.word.begin, std::max(offset_, cursor_.word.begin)};
        collect();
        if (list_.items.size() > options_.limit) keepBest();
        std::sort(list_.items.begin(), list_.items.end(), isBefore);
        for (CompletionItem& item : list_.items)
            if (item.symbol && item.detail.empty()) {
                item.key = keyOf(snapshot_, *item.symbol);
                item.detail = detailOf(*item.symbol);
            }
        return std::move(list_);
    }

  private:
    static bool isBefore(const CompletionItem& a, const CompletionItem& b) {
        return std::tie(a.sortText, a.label) < std::tie(b.sortText, b.label);
    }
    /// Drops the items beyond the limit.
    void keepBest() {
        const auto end = list_.items.begin() + static_cast<std::ptrdiff_t>(options_.limit);
        std::nth_element(list_.items.begin(), end, list_.items.end(), isBefore);
        firstDropped_ = end->sortText;
        list_.items.erase(end, list_.items.end());
        list_.incomplete = true;
    }
    /// Whether an item with these ranks and seriesKey() of the name to sort by would be dropped: enough others come before it. Most names
    /// differ in their first letters: no text is made for them.
    bool isBeyond(char rank, char secondRank, const std::string& name) const {
        if (firstDropped_.size() < 2) return false;
        if (rank != firstDropped_[0]) return rank > firstDropped_[0];
        if (secondRank != firstDropped_[1]) return secondRank > firstDropped_[1];
        const std::string_view key = std::string_view(firstDropped_).substr(2);
        const size_t letters = name.find_last_not_of("0123456789") + 1; // before the number at the end
        const size_t common = std::min(letters, key.size());
        if (const int order =
                config::compareNames(std::string_view(name).substr(0, common), key.substr(0, common));
            order != 0)
            return order > 0;
        return seriesKey(name) > key;
    }
    bool isBeyond(char rank, std::string_view name) const {
        if (firstDropped_.empty() || rank != firstDropped_.front())
            return !firstDropped_.empty() && rank > firstDropped_.front();
        return config::compareNames(name, std::string_view(firstDropped_).substr(1)) > 0;
    }

    void collect() {
        switch (cursor_.expect) {
        case Expect::Nothing: return;
        case Expect::File: return constructs(fileConstructs());
        case Expect::Declaration: return declarations();
        case Expect::Statement: return statements();
        case Expect::Expression:
        case Expect::Target: return values();
        case Expect::TypeName: return types();
        case Expect::Component: return components();
        case Expect::OptionalName: return optionalNames();
        case Expect::Label:
            for (const LabelSymbol* label : scope_.labels())
                add(*label, kBest, true);
            return;
        case Expect::ModuleName: return modules();
        case Expect::Trap:
        case Expect::LateName:
            return routinesOf(cursor_.expect == Expect::Trap ? RoutineKind::Trap : RoutineKind::Proc);
        case Expect::Keyword: return keywords();
        }
    }

    bool matches(std::string_view name) const { return fuzzyMatch(cursor_.prefix, name); }

    /// The rank of a name that has to share the list with others.
    char ranked(char rank, std::string_view name) const {
        const std::string_view typed = cursor_.prefix;
        if (typed.empty()) return rank;
        const bool begins = name.size() >= typed.size() && equalsNoCase(name.substr(0, typed.size()), typed);
        if (!begins) return static_cast<char>(rank - kBest + 'A');
        return name.size() == typed.size() ? static_cast<char>(kTyped) : rank;
    }

    CompletionItem& append(std::string label, ItemKind kind, char rank, std::string insertText) {
        // In large programs nearly all items are dropped: early, so that they need no room.
        if (list_.items.size() / 2 > options_.limit) keepBest();
        CompletionItem& item = list_.items.emplace_back();
        item.label = std::move(label);
        item.kind = kind;
        item.sortText = ranked(rank, item.label) + foldName(item.label);
        item.filterText = item.label;
        item.insertText = std::move(insertText);
        return item;
    }

    char rankOf(const Symbol& symbol) const {
        const DataSymbol* data = dataOf(&symbol);
        if (data && data->storage == Storage::Signal) return kTask;
        if (symbol.predefined) return symbol.used && routineOf(&symbol) ? kUsed : kLibrary;
        if (data && data->routine) return kLocal;
        return symbol.module == scope_.around().module ? kModule : kTask;
    }

    CompletionItem* add(const Symbol& symbol, char rank, bool fits) {
        if (isBeyond(ranked(rank, symbol.name), symbol.name) || !matches(symbol.name)) return nullptr;
        return &addItem(symbol, rank, fits);
    }
    CompletionItem& addItem(const Symbol& symbol, char rank, bool fits) {
        CompletionItem& item = append(symbol.name, kindOf(symbol), rank, symbol.name);
        item.fits = fits;
        item.symbol = &symbol;
        return item;
    }

    std::string detailOf(const Symbol& symbol) const {
        if (const DataSymbol* data = dataOf(&symbol)) {
            if (data->storage == Storage::Signal || data->storage == Storage::Parameter ||
                data->storage == Storage::LoopVariable)
                return typeText(data->type);
            return std::string(data->dataKind == DataKind::Const  ? "CONST "
                               : data->dataKind == DataKind::Pers ? "PERS "
                                                                  : "VAR ") +
                   typeText(data->type);
        }
        if (const RoutineSymbol* routine = routineOf(&symbol)) return routineLabel(*routine).text;
        if (const TypeSymbol* type = typeSymbolOf(&symbol); type && type->type)
            return type->type->aliasOf ? "ALIAS " + type->type->aliasOf->name
                   : type->type->kind == TypeKind::Record && !type->type->components.empty() ? "RECORD"
                                                                                             : "type";
        return {};
    }

    // ---- By what is expected -----------------------------------------------------------------------------------

    void constructs(std::span<const Construct> all) {
        for (const Construct& construct : all) {
            if (!matches(construct.label)) continue;
            const bool closes = construct.label.starts_with("END");
            CompletionItem& item = append(std::string(construct.label),
                                          construct.snippet.empty() ? ItemKind::Keyword : ItemKind::Snippet,
                                          closes ? kRare : kOther, std::string(construct.plain));
            if (!restOfLine()) item.snippet = std::string(construct.snippet);
            item.detail = std::string(construct.detail);
        }
    }

    void declarations() { constructs(declarationConstructs()); }

    /// Something other than a comment follows the word on its line.
    bool restOfLine() const {
        const TokenIndex next = tokenFrom(file_, std::max(cursor_.word.end, offset_));
        if (next == kNoToken || file_.tree->tokens[next].kind == TokenKind::EndOfFile) return false;
        const uint32_t end = file_.tree->tokens[next].offset;
        const uint32_t from = std::max(cursor_.word.end, offset_);
        return end >= from &&
               file_.text().substr(from, end - from).find_first_of("\r\n") == std::string_view::npos;
    }
    char nextCharacter() const {
        const size_t at = file_.text().find_first_not_of(" \t", std::max(cursor_.word.end, offset_));
        return at == std::string_view::npos ? '\n' : file_.text()[at];
    }

    void statements() {
        constructs(statementConstructs());
        constructs(handlerConstructs());
        instructions();
    }
    void instructions() {
        const bool rest = restOfLine();
        for (const Symbol* symbol : scope_.visible(cancel_, cursor_.prefix)) {
            if (isCancelled(cancel_)) return;
            if (const RoutineSymbol* routine = routineOf(symbol)) {
                if (routine->routineKind == RoutineKind::Proc) addCall(*routine, rest);
            } else if (const DataSymbol* data = dataOf(symbol); data && isAssignable(*data)) {
                add(*symbol, rankOf(*symbol), false);
            }
        }
    }

    static bool isAssignable(const DataSymbol& data) {
        if (data.predefined || data.isSwitch || data.storage == Storage::LoopVariable ||
            data.storage == Storage::Signal || data.storage == Storage::SystemVariable || !data.type.type)
            return false;
        if (data.storage == Storage::Parameter) return true;
        return data.dataKind != DataKind::Const;
    }

    void addCall(const RoutineSymbol& routine, bool rest) {
        CompletionItem* item = add(routine, rankOf(routine), false);
        if (!item || rest) return;
        const std::string arguments = requiredArguments(routine);
        item->snippet = escaped(routine.name) + (arguments.empty() ? "" : " " + arguments) + ";$0";
    }

    /// Types of an argument that is known to be absent or present: that of the argument.
    void optionalParameters() {
        if (!scope_.around().routine) return;
        const Type* type = cursor_.type.type;
        for (const DataSymbol* param : scope_.around().routine->params)
            if (param->optional && (!type || (param->type.type && param->type.type->base() == type->base())))
                add(*param, kBest, true);
    }

    void values() {
        if (cursor_.optionalParameter) return optionalParameters();
        const std::vector<Cursor> wanted = alternatives();
        std::vector<FitRules> rules(wanted.begin(), wanted.end());
        const bool callFollows = nextCharacter() == '(';
        scope_.forEachVisible(cancel_, cursor_.prefix, [&](const Symbol& symbol) {
            if (symbol.kind == SymbolKind::Type || equalsNoCase(symbol.name, cursor_.declares)) return;
            Fit fit = Fit::Misfit;
            for (const FitRules& one : rules)
                fit = std::min(fit, one.of(symbol));
            if (fit != Fit::Misfit) addValue(symbol, fit, callFollows);
        });
        if (isCancelled(cancel_)) return;
        if (cursor_.mode == ParamMode::In && cursor_.expect == Expect::Expression) constants();
        if (options_.newData) newPoint();
    }

    /// The expected type, once for each parameter that the argument may belong to.
    std::vector<Cursor> alternatives() const {
        std::vector<Cursor> all(std::max<size_t>(1, cursor_.alternatives.size()), cursor_);
        for (size_t i = 0; i < cursor_.alternatives.size(); ++i) {
            const DataSymbol& param = *cursor_.alternatives[i];
            all[i].anyType = param.type.type && param.type.type->kind == TypeKind::AnyType;
            all[i].type = all[i].anyType ? DataType{} : param.type;
            all[i].mode = param.mode;
            all[i].accepts = param.accepts;
        }
        return all;
    }

    void addValue(const Symbol& symbol, Fit fit, bool callFollows) {
        char rank = rankOf(symbol);
        const bool typed = cursor_.type.type != nullptr;
        if (typed && fit == Fit::Exact)
            rank = symbol.predefined && !isConstant(symbol) ? kLocal : kBest;
        else if (fit == Fit::Reach)
            rank = symbol.predefined ? kRare : kLoose;
        CompletionItem* item = nullptr;
        if (typed && fit == Fit::Exact) {
            const char firstRank = ranked(rank, symbol.name), secondRank = rankOf(symbol);
            if (isBeyond(firstRank, secondRank, symbol.name)) return;
            item = &addItem(symbol, rank, true);
            item->sortText = std::string{firstRank, secondRank} + seriesKey(symbol.name);
        } else {
            item = add(symbol, rank, fit != Fit::Reach);
        }
        if (!item) return;
        const RoutineSymbol* routine = routineOf(&symbol);
        if (!routine) return;
        if (callFollows) return;
        item->insertText = routine->name + "(";
        item->snippet = escaped(routine->name) + "(" + requiredArguments(*routine) + ")$0";
        if (routine->params.empty()) item->insertText += ")";
    }
    static bool isConstant(const Symbol& symbol) { return dataOf(&symbol) != nullptr; }

    /// v50 before v100: the numbers at the end of names in order.
    static std::string seriesKey(const std::string& name) {
        size_t digits = name.size();
        while (digits > 0 && name[digits - 1] >= '0' && name[digits - 1] <= '9')
            --digits;
        if (digits == name.size() || name.size() - digits > 8) return foldName(name);
        return foldName(name.substr(0, digits)) + std::string(8 - (name.size() - digits), '0') +
               name.substr(digits);
    }

    void constants() {
        const CheckedProgram& program = snapshot_.program();
        const Type* type = cursor_.type.type ? cursor_.type.type->base() : nullptr;
        if (!type || type == program.boolean || cursor_.anyType)
            for (const char* word : {"TRUE", "FALSE"})
                if (matches(word))
                    append(word, ItemKind::Value, type ? kBest : kOther, word).fits = type != nullptr;
        if ((!type || type == program.boolean) && matches("NOT"))
            append("NOT", ItemKind::Keyword, kOther, "NOT ");
    }

    /// A point that is declared when the item is chosen.
    void newPoint() {
        const Type* type = cursor_.type.type;
        const Module* module = scope_.around().module;
        if (!type || cursor_.type.isArray() || !module || !cursor_.call || !cursor_.call->atStart ||
            cursor_.mode != ParamMode::In || (type->module && !type->module->predefined) ||
            !scope_.around().routine)
            return;
        if (type->name != "robtarget" && type->name != "jointtarget") return;
        std::string name(file_.text().substr(cursor_.word.begin, cursor_.word.end - cursor_.word.begin));
        if (name.empty() || scope_.find(name) || keywordKind(name) != TokenKind::Identifier)
            name = freeName(scope_, name.empty() ? type->name == "robtarget" ? "p" : "jpos" : name + "_", 10,
                            10);
        const InsertPlace place = moduleDataPlace(file_, *module);
        if (!place.usable || name.size() > 32) return;
        CompletionItem& item = append(name, ItemKind::NewData, kLoose, name);
        item.detail = "new CONST " + type->name;
        item.fits = true;
        item.edits.push_back(
            place.edit(fmt::format("CONST {} {}:={};", type->name, name, initialText(cursor_.type))));
    }

    void types() {
        for (const TokenKind word : cursor_.keywords)
            keyword(word);
        const bool parameter = !cursor_.keywords.empty();
        for (const Symbol* symbol : scope_.visible(cancel_, cursor_.prefix)) {
            const TypeSymbol* type = typeSymbolOf(symbol);
            if (!type || !type->type || type->type->kind == TypeKind::AnyType || type->name == "signalxx")
                continue;
            if (type->type->kind == TypeKind::Switch && !parameter) continue;
            static constexpr std::string_view kUsual[] = {"num",         "bool",     "string",   "robtarget",
                                                          "jointtarget", "pos",      "tooldata", "wobjdata",
                                                          "speeddata",   "zonedata", "intnum"};
            const bool usual =
                std::find(std::begin(kUsual), std::end(kUsual), type->name) != std::end(kUsual);
            add(*symbol, symbol->predefined ? usual ? kBest : kLibrary : kLocal, true);
        }
    }

    void components() {
        if (!cursor_.record) return;
        const Type& record = *cursor_.record->base();
        for (size_t i = 0; i < record.components.size(); ++i) {
            const Type::Component& component = record.components[i];
            if (!matches(component.name)) continue;
            CompletionItem& item = append(component.name, ItemKind::Component, kBest, component.name);
            item.sortText = fmt::format("{}{:04}", ranked(kBest, component.name), i);
            item.detail = component.type ? component.type->name : "";
            Meaning meaning;
            meaning.record = &record;
            meaning.component = static_cast<int>(i);
            item.key = keyOf(snapshot_, meaning);
        }
    }

    void optionalNames() {
        if (!cursor_.call || !cursor_.call->routine) return;
        size_t number = 0;
        for (const DataSymbol* param : optionalChoices(*cursor_.call)) {
            if (!matches(param->name)) continue;
            const bool value = !param->isSwitch && nextCharacter() != ':';
            CompletionItem& item =
                append(param->name, ItemKind::OptionalArgument, kBest, param->name + (value ? ":=" : ""));
            item.sortText = fmt::format("{}{:04}", ranked(kBest, param->name), number++);
            item.detail = parameterText(*param);
            item.key = keyOf(snapshot_, *param);
            if (value)
                item.snippet = escaped(param->name) +
                               ":=${1:" + escaped(param->type.type ? param->type.type->name : "value") +
                               "}$0";
            item.fits = true;
        }
    }

    void modules() {
        if (!file_.task) return;
        for (const Module* module : file_.task->modules)
            if (!module->name.empty() && matches(module->name))
                append(module->name, ItemKind::Module, kBest, module->name);
    }

    void routinesOf(RoutineKind kind) {
        for (const Symbol* symbol : scope_.visible(cancel_, cursor_.prefix)) {
            const RoutineSymbol* routine = routineOf(symbol);
            if (routine && routine->routineKind == kind) add(*symbol, rankOf(*symbol), !routine->predefined);
        }
    }

    void keyword(TokenKind word) {
        const std::string text(tokenText(word));
        if (matches(text)) append(text, ItemKind::Keyword, kBest, text);
    }
    void keywords() {
        for (const TokenKind word : cursor_.keywords)
            keyword(word);
        if (cursor_.instruction) instructions();
    }

    const Snapshot& snapshot_;
    const FileView& file_;
    uint32_t offset_;
    const CompletionOptions& options_;
    const Cancel* cancel_;
    Scope scope_;
    Cursor cursor_;
    CompletionList list_;
    std::string
        firstDropped_; ///< `sortText` of the first item beyond the limit; empty: none has been dropped
};

} // namespace

CompletionList completionAt(const Snapshot& snapshot, const FileView& file, uint32_t offset,
                            const CompletionOptions& options, const Cancel* cancel) {
    offset = std::min(offset, static_cast<uint32_t>(file.text().size()));
    return Completer(snapshot, file, offset, options, cancel).run();
}

ItemDocumentation resolveItem(const Snapshot& snapshot, std::string_view key) {
    const Meaning meaning = meaningOfKey(snapshot, key);
    if (!meaning.found()) return {};
    return {declarationText(snapshot, meaning), documentationOf(snapshot, meaning)};
}

} // namespace rapid::query
