#include "stdlib/gen/model.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unordered_map>

namespace stdlibgen {

namespace syn = rapid::syntax;

namespace {

std::string collapsed(std::string_view text) {
    std::string out;
    bool gap = false;
    for (const char c : text) {
        if (std::isspace(static_cast<unsigned char>(c))) {
            gap = !out.empty();
            continue;
        }
        if (gap && out.back() != '(') out += ' ';
        gap = false;
        out += c;
    }
    return out;
}

/// A literal number, perhaps with a sign; anything else has no value here.
std::optional<double> literalNumber(const syn::Expr* expr) {
    if (!expr) return std::nullopt;
    if (expr->kind == syn::NodeKind::NumLiteral) return syn::as<syn::NumLiteralExpr>(*expr).value;
    if (expr->kind == syn::NodeKind::Unary) {
        const auto& unary = syn::as<syn::UnaryExpr>(*expr);
        const std::optional<double> inner = literalNumber(unary.operand);
        if (!inner || unary.op == syn::UnaryOp::Not) return std::nullopt;
        return unary.op == syn::UnaryOp::Minus ? -*inner : *inner;
    }
    return std::nullopt;
}

Repr reprOf(const std::string& name, const std::string& classWord) {
    const std::string key = rapid::config::lowerCase(name);
    if (key == "num") return Repr::Num;
    if (key == "dnum") return Repr::Dnum;
    if (key == "bool") return Repr::Bool;
    if (key == "string") return Repr::String;
    if (key == "switch") return Repr::Switch;
    if (key == "anytype" || classWord == "pseudo") return Repr::Any;
    if (classWord.starts_with("nonvalue") || classWord.starts_with("semivalue")) return Repr::Handle;
    return Repr::Record;
}

class Reader {
  public:
    explicit Reader(Model& model) : model_(model) {}

    void readFile(const std::string& path) {
        std::ifstream in(path, std::ios::binary);
        if (!in) {
            model_.errors.push_back(path + ": the file cannot be read");
            return;
        }
        std::stringstream buffer;
        buffer << in.rdbuf();
        const std::filesystem::path p(path);
        model_.sources.push_back(
            {p.parent_path().filename().string() + "/" + p.filename().string(), path, buffer.str()});
        path_ = path;
        rapid::diag::Sink sink;
        auto source = std::make_shared<rapid::SourceFile>(path, buffer.str());
        const auto tree = syn::parse(source, sink, {.declarations = true});
        for (const auto& d : sink.sorted()) {
            const auto at = source->lineColumn(d.range.begin);
            model_.errors.push_back(fmt::format("{}:{}:{}: {}", path, at.line, at.column, d.message));
        }
        tree_ = tree.get();
        stage_ = Stage::Types;
        for (const auto* module : tree->modules)
            for (const auto* decl : module->decls)
                readDecl(*decl);
    }

  private:
    enum class Stage : uint8_t { Types, Data, Routines };

    void enter(Stage stage, const syn::Decl& decl) {
        if (stage < stage_) fail(place(decl), "the order in a file is: types, data, routines");
        stage_ = std::max(stage, stage_);
    }

    void readDecl(const syn::Decl& decl) {
        switch (decl.kind) {
        case syn::NodeKind::Record:
            enter(Stage::Types, decl);
            readRecord(syn::as<syn::RecordDecl>(decl));
            break;
        case syn::NodeKind::Alias:
            enter(Stage::Types, decl);
            readAlias(syn::as<syn::AliasDecl>(decl));
            break;
        case syn::NodeKind::Data:
            enter(Stage::Data, decl);
            readData(syn::as<syn::DataDecl>(decl));
            break;
        case syn::NodeKind::Routine:
            enter(Stage::Routines, decl);
            readRoutine(syn::as<syn::RoutineDecl>(decl));
            break;
        default: break; // reported by the parser
        }
    }

    std::string word(syn::TokenIndex token) const { return std::string(tree_->text(token)); }
    std::string written(const syn::Node& node) const {
        const rapid::SourceRange r = tree_->range(node);
        return std::string(tree_->source->text().substr(r.begin, r.end - r.begin));
    }
    Place place(const syn::Node& node) const {
        return {path_, tree_->source->lineColumn(tree_->range(node).begin).line};
    }
    void fail(const Place& where, const std::string& message) {
        model_.errors.push_back(fmt::format("{}:{}: {}", where.file, where.line, message));
    }

    Doc documentation(const syn::Node& node, const std::string& name) {
        std::string problem;
        Doc doc = readDocumentation(tree_->source->text(), tree_->range(node).begin, problem);
        if (!problem.empty()) fail(place(node), fmt::format("'{}': {}", name, problem));
        declareName(node, name);
        return doc;
    }

    void declareName(const syn::Node& node, const std::string& name) {
        const Place here = place(node);
        const auto [at, fresh] = names_.try_emplace(rapid::config::lowerCase(name), here);
        if (fresh) return;
        fail(here,
             fmt::format("'{}' is declared twice, first at {}:{}", name, at->second.file, at->second.line));
    }

    void readRecord(const syn::RecordDecl& decl) {
        TypeInfo type;
        type.name = word(decl.name);
        type.place = place(decl);
        type.doc = documentation(decl, type.name);
        type.repr = reprOf(type.name, type.doc.get("class"));
        if (const std::string bytes = type.doc.get("bytes"); !bytes.empty()) {
            type.repr = Repr::Bytes;
            const auto end = bytes.data() + bytes.size();
            if (std::from_chars(bytes.data(), end, type.bytes).ptr != end || type.bytes == 0)
                fail(type.place, fmt::format("'{}': bytes must be a number above 0", type.name));
        }
        for (const auto* c : decl.components)
            type.fields.push_back({word(c->type), word(c->name)});
        if (type.repr == Repr::Record && type.fields.empty())
            fail(type.place,
                 fmt::format("record '{}' has no component: add one, or !@ class: nonvalue", type.name));
        model_.types.push_back(std::move(type));
    }

    void readAlias(const syn::AliasDecl& decl) {
        TypeInfo type;
        type.name = word(decl.name);
        type.aliasOf = word(decl.type);
        type.place = place(decl);
        type.doc = documentation(decl, type.name);
        const Repr own = reprOf(type.name, type.doc.get("class"));
        if (own == Repr::Handle) type.aliasOf.clear(); // declared as an alias for want of a better form
        type.repr = own;
        model_.types.push_back(std::move(type));
    }

    void readData(const syn::DataDecl& decl) {
        Datum datum;
        datum.kind = decl.dataKind == syn::DataKind::Const  ? "CONST"
                     : decl.dataKind == syn::DataKind::Pers ? "PERS"
                                                            : "VAR";
        datum.type = word(decl.type);
        datum.name = word(decl.name);
        datum.place = place(decl);
        datum.doc = documentation(decl, datum.name);
        if (decl.init) datum.initText = collapsed(written(*decl.init));
        if (decl.dims.empty()) datum.number = literalNumber(decl.init);
        model_.data.push_back(std::move(datum));
    }

    Param readParam(const syn::ParamDecl& decl) const {
        Param param;
        param.mode = static_cast<Mode>(decl.mode);
        param.isSwitch = decl.isSwitch;
        param.optional = decl.optional;
        param.group = decl.group;
        param.type = decl.isSwitch ? "switch" : word(decl.type);
        param.name = word(decl.name);
        param.rank = decl.rank;
        return param;
    }

    void readRoutine(const syn::RoutineDecl& decl) {
        Routine routine;
        routine.name = word(decl.name);
        routine.returnType = word(decl.returnType);
        routine.place = place(decl);
        routine.native = !decl.hasBody;
        routine.doc = documentation(decl, routine.name);
        routine.role = rapid::sema::valueOf(rapid::sema::kRoleWords, routine.doc.get("role"))
                           .value_or(rapid::sema::Role::None);
        for (const auto* p : decl.params)
            routine.params.push_back(readParam(*p));
        for (Param& p : routine.params) {
            if (p.optional) continue;
            for (const Param& q : routine.params)
                p.alternative |= &p != &q && p.group == q.group && !q.optional;
        }
        if (const std::string problem = whereProblem(routine); !problem.empty())
            fail(routine.place, fmt::format("'{}': {}", routine.name, problem));
        const std::string text = written(decl);
        const size_t close = text.find(')');
        routine.signature = collapsed(text.substr(0, close == std::string::npos ? close : close + 1));
        model_.routines.push_back(std::move(routine));
    }

    Model& model_;
    const syn::SyntaxTree* tree_ = nullptr;
    std::string path_;
    Stage stage_ = Stage::Types; ///< of the file
    std::unordered_map<std::string, Place> names_;
};

void checkType(Model& model, const std::string& type, const Place& where, const std::string& owner) {
    if (model.findType(type)) return;
    model.errors.push_back(
        fmt::format("{}:{}: '{}' uses the unknown type '{}': declare it or correct the spelling", where.file,
                    where.line, owner, type));
}

void checkModel(Model& model) {
    for (TypeInfo& type : model.types) {
        for (const auto& field : type.fields)
            checkType(model, field.type, type.place, type.name);
        if (type.aliasOf.empty()) continue;
        checkType(model, type.aliasOf, type.place, type.name);
    }
    for (TypeInfo& type : model.types) {
        const TypeInfo* base = model.baseType(type.name);
        if (base) type.repr = base->repr;
    }
    for (const Datum& datum : model.data)
        checkType(model, datum.type, datum.place, datum.name);
    for (const Routine& routine : model.routines) {
        if (!routine.returnType.empty()) checkType(model, routine.returnType, routine.place, routine.name);
        for (const Param& p : routine.params)
            checkType(model, p.type, routine.place, routine.name);
    }
}

/// Types that the language has without a declaration; a declaration in decl/ takes their place.
void addLanguageTypes(Model& model) {
    for (const char* name : {"num", "dnum", "bool", "string", "switch", "anytype"}) {
        if (model.findType(name)) continue;
        TypeInfo type;
        type.name = name;
        type.repr = reprOf(name, {});
        model.types.push_back(std::move(type));
    }
}

} // namespace

const TypeInfo* Model::findType(std::string_view name) const {
    const std::string key = rapid::config::lowerCase(name);
    for (const TypeInfo& type : types)
        if (rapid::config::lowerCase(type.name) == key) return &type;
    return nullptr;
}

const TypeInfo* Model::baseType(std::string_view name) const {
    const TypeInfo* type = findType(name);
    for (int depth = 0; type && !type->aliasOf.empty() && depth < 16; ++depth)
        type = findType(type->aliasOf);
    return type;
}

Model readDeclarations(const std::vector<std::string>& paths) {
    Model model;
    Reader reader(model);
    for (const std::string& path : paths)
        reader.readFile(path);
    addLanguageTypes(model);
    checkModel(model);
    return model;
}

} // namespace stdlibgen
