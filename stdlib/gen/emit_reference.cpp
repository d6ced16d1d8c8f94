#include "stdlib/gen/emit.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <sstream>

namespace stdlibgen {

namespace {

using Json = nlohmann::ordered_json;

Json common(const std::string& name, const char* kind, const Doc& doc) {
    Json entry;
    entry["name"] = name;
    entry["kind"] = kind;
    entry["doc"] = doc.text;
    for (const char* key : {"manual", "raises", "option", "confidence"})
        if (const std::string value = doc.get(key); !value.empty()) entry[key] = value;
    return entry;
}

const char* kindOf(const Routine& r) {
    return r.returnType.empty() ? "instruction" : "function";
}

std::string typeText(const TypeInfo& type) {
    if (!type.aliasOf.empty()) return "alias of " + type.aliasOf;
    if (type.fields.empty()) return type.repr == Repr::Handle ? "handle" : "atomic";
    std::string out = "record";
    for (const auto& f : type.fields)
        out += fmt::format(" {} {};", f.type, f.name);
    return out;
}

/// Chapter numbers in natural order: 1.2 before 1.10.
bool chapterLess(const std::string& a, const std::string& b) {
    const char* p = a.c_str() + std::min(a.size(), a.find_first_of("0123456789"));
    const char* q = b.c_str() + std::min(b.size(), b.find_first_of("0123456789"));
    while (true) {
        char* pe = nullptr;
        char* qe = nullptr;
        const long x = std::strtol(p, &pe, 10);
        const long y = std::strtol(q, &qe, 10);
        if (pe == p || qe == q) return (pe == p) != (qe == q) ? pe != p : a < b; // numbers come first
        if (x != y) return x < y;
        p = *pe == '.' ? pe + 1 : pe;
        q = *qe == '.' ? qe + 1 : qe;
    }
}

struct Section {
    std::string title;
    std::vector<std::string> blocks;
};

std::string chapterOf(const Doc& doc) {
    const std::string manual = doc.get("manual");
    return manual.empty() || manual == "-" ? "Not in the overview manual" : "Chapter " + manual;
}

/// The word after "@tag " and the rest of the line.
std::pair<std::string, std::string> firstWord(const std::string& text) {
    const size_t space = text.find(' ');
    if (space == std::string::npos) return {text, ""};
    return {text.substr(0, space), text.substr(text.find_first_not_of(' ', space))};
}

/// Documentation lines as Markdown: summary, arguments, result, examples. Errors stand in the attributes.
std::string markdown(const std::string& doc) {
    std::istringstream lines(doc);
    std::string text, params, examples;
    for (std::string line; std::getline(lines, line);) {
        const auto [tag, rest] = firstWord(line);
        if (tag == "@param") {
            const auto [name, meaning] = firstWord(rest);
            params += fmt::format("- `{}`: {}\n", name, meaning);
        } else if (tag == "@return") {
            params += fmt::format("- result: {}\n", rest);
        } else if (tag == "@example") {
            examples += rest + "\n";
        } else if (!tag.starts_with('@')) {
            text += line + "\n";
        }
    }
    if (!params.empty()) text += "\n" + params;
    if (!examples.empty()) text += "\nExample:\n\n```\n" + examples + "```\n";
    return text;
}

std::string routineBlock(const Routine& r) {
    std::string out = fmt::format("### {}\n\n```\n{}\n```\n\n{}", r.name, r.signature, markdown(r.doc.text));
    if (const std::string e = r.doc.get("raises"); !e.empty()) out += fmt::format("\nErrors: {}.\n", e);
    if (const std::string o = r.doc.get("option"); !o.empty() && o != "-")
        out += fmt::format("\nOption: {}.\n", o);
    return out;
}

} // namespace

std::string emitJson(const Model& model) {
    Json all = Json::array();
    for (const Routine& r : model.routines) {
        Json entry = common(r.name, kindOf(r), r.doc);
        entry["signature"] = r.signature;
        Json params = Json::array();
        for (const Param& p : r.params) {
            Json param = {{"name", p.name}, {"type", p.type}, {"optional", p.optional}};
            if (p.rank > 0) param["rank"] = p.rank;
            params.push_back(std::move(param));
        }
        entry["params"] = std::move(params);
        if (!r.returnType.empty()) entry["returns"] = r.returnType;
        all.push_back(std::move(entry));
    }
    for (const TypeInfo& t : model.types) {
        Json entry = common(t.name, "datatype", t.doc);
        entry["signature"] = typeText(t);
        all.push_back(std::move(entry));
    }
    for (const Datum& d : model.data) {
        Json entry = common(d.name, d.kind == "CONST" ? "constant" : "data", d.doc);
        entry["signature"] =
            fmt::format("{} {} {}{}", d.kind, d.type, d.name, d.initText.empty() ? "" : " := " + d.initText);
        all.push_back(std::move(entry));
    }
    return all.dump(1) + "\n";
}

std::string emitReference(const Model& model) {
    std::map<std::string, Section, decltype(&chapterLess)> sections(&chapterLess);
    for (const Routine& r : model.routines)
        sections[chapterOf(r.doc)].blocks.push_back(routineBlock(r));
    std::string out =
        "# Predefined instructions, functions, data types and data\n\n"
        "Generated from the declarations in `stdlib/decl` and `stdlib/data`; chapter numbers are those of "
        "the manual.\n";
    for (const auto& [chapter, section] : sections) {
        out += fmt::format("\n## {}\n", chapter);
        for (const std::string& block : section.blocks)
            out += "\n" + block;
    }
    out += "\n## Data types\n\n| type | form | |\n|---|---|---|\n";
    for (const TypeInfo& t : model.types)
        out += fmt::format("| {} | {} | {} |\n", t.name, typeText(t), t.doc.summary());
    out += "\n## Predefined data\n\n| name | type | value | |\n|---|---|---|---|\n";
    for (const Datum& d : model.data)
        out += fmt::format("| {} | {} | {} | {} |\n", d.name, d.type, d.initText, d.doc.summary());
    return out;
}

} // namespace stdlibgen
