#include "config/json_text.h"
#include "stdlib/gen/emit.h"

#include <fmt/format.h>

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
    if (type.repr == Repr::Bytes) return fmt::format("container of {} bytes", type.bytes);
    if (type.fields.empty()) return type.repr == Repr::Handle ? "handle" : "atomic";
    std::string out = "record";
    for (const auto& f : type.fields)
        out += fmt::format(" {} {};", f.type, f.name);
    return out;
}

/// Text that Markdown must not read as markup, inside a cell of a table too.
std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (std::string_view("|<>*_[]\\").find(c) != std::string_view::npos) out += '\\';
        out += c;
    }
    return out;
}

/// Documentation lines as Markdown: summary, arguments, result, errors, examples.
std::string markdown(const std::string& doc) {
    std::istringstream lines(doc);
    std::string text, items, examples;
    std::string* last = &text; // continuation lines go where the line before them went
    for (std::string line; std::getline(lines, line);) {
        const auto [tag, rest] = splitFirstWord(line);
        if (tag == "@param" || tag == "@error") {
            const auto [name, meaning] = splitFirstWord(rest);
            items += fmt::format("- `{}`: {}\n", name, escaped(meaning));
            last = &items;
        } else if (tag == "@return") {
            items += fmt::format("- result: {}\n", escaped(rest));
            last = &items;
        } else if (tag == "@example") {
            examples += rest + "\n";
            last = &examples;
        } else if (!line.empty() && last == &items) {
            items.insert(items.size() - 1, " " + escaped(line.substr(line.find_first_not_of(' '))));
        } else {
            *last += (last == &text ? escaped(line) : line) + "\n";
        }
    }
    if (!items.empty()) text += "\n" + items;
    if (!examples.empty()) text += "\n```\n" + examples + "```\n";
    return text;
}

std::string remarks(const Doc& doc) {
    std::string out;
    const auto add = [&out](const std::string& text) { out += (out.empty() ? "" : " ") + text; };
    if (const std::string m = doc.get("manual"); !m.empty() && m != "-") add("Chapter " + m + ".");
    if (const std::string o = doc.get("option"); !o.empty() && o != "-") add("Option: " + o + ".");
    const std::string confidence = doc.get("confidence");
    if (confidence == "medium") add("The form of the call is not confirmed in every detail.");
    if (confidence == "low") add("The form of the call is not confirmed.");
    return out.empty() ? out : "\n" + out + "\n";
}

std::string routineBlock(const Routine& r) {
    return fmt::format("\n## {}\n\n```\n{}\n```\n\n{}{}", r.name, r.signature, markdown(r.doc.text),
                       remarks(r.doc));
}

constexpr const char* kGenerated =
    "\nGenerated from the declarations in `stdlib` by `./dev reference`; do not edit.\n";

/// "decl/math.sysx" -> "math".
std::string stemOf(const std::string& source) {
    const size_t slash = source.rfind('/');
    return source.substr(slash + 1, source.rfind('.') - slash - 1);
}

/// The first comment inside the module names the subject of the file.
std::string titleOf(const SourceText& source) {
    std::istringstream lines(source.text);
    for (std::string line; std::getline(lines, line);) {
        const size_t start = line.find_first_not_of(' ');
        if (start != std::string::npos && line[start] == '!' && line.compare(start, 2, "!!") != 0) {
            std::string title = line.substr(line.find_first_not_of(' ', start + 1));
            while (title.ends_with('.'))
                title.pop_back();
            return title;
        }
    }
    return stemOf(source.name);
}

Page typePage(const Model& model) {
    std::string text = fmt::format("# Data types\n{}\n| type | form | |\n|---|---|---|\n", kGenerated);
    for (const TypeInfo& t : model.types)
        text += fmt::format("| {} | {} | {} |\n", escaped(t.name), escaped(typeText(t)),
                            escaped(t.doc.summary()));
    return {"types.md", std::move(text)};
}

Page dataPage(const Model& model) {
    std::string text =
        fmt::format("# Predefined data\n{}\nNumbers of error constants are rapidc's own; use the names.\n\n"
                    "| name | type | value | |\n|---|---|---|---|\n",
                    kGenerated);
    for (const Datum& d : model.data)
        text += fmt::format("| {} | {} | {} | {} |\n", escaped(d.name), escaped(d.type), escaped(d.initText),
                            escaped(d.doc.summary()));
    return {"data.md", std::move(text)};
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
        entry["type"] = d.type;
        entry["value"] = d.initText;
        entry["signature"] =
            fmt::format("{} {} {}{}", d.kind, d.type, d.name, d.initText.empty() ? "" : " := " + d.initText);
        all.push_back(std::move(entry));
    }
    return rapid::config::textOf(all, 1) + "\n";
}

std::vector<Page> emitReference(const Model& model) {
    std::vector<Page> pages;
    std::string index = fmt::format("# Everything predefined\n{}\nBy subject:\n\n", kGenerated);
    std::map<std::string, std::string> byName;
    for (const SourceText& source : model.sources) {
        std::string blocks;
        const std::string file = stemOf(source.name) + ".md";
        for (const Routine& r : model.routines) {
            if (r.place.file != source.path) continue;
            blocks += routineBlock(r);
            byName[rapid::config::lowerCase(r.name)] =
                fmt::format("| [{}]({}#{}) | {} |\n", r.name, file, rapid::config::lowerCase(r.name),
                            escaped(r.doc.summary()));
        }
        if (blocks.empty()) continue;
        const std::string title = titleOf(source);
        index += fmt::format("- [{}]({})\n", title, file);
        pages.push_back({file, fmt::format("# {}\n{}{}", title, kGenerated, blocks)});
    }
    index +=
        "- [Data types](types.md)\n- [Predefined data](data.md)\n\n## By name\n\n| name | |\n|---|---|\n";
    for (const auto& [name, row] : byName)
        index += row;
    pages.push_back(typePage(model));
    pages.push_back(dataPage(model));
    pages.push_back({"README.md", std::move(index)});
    return pages;
}

} // namespace stdlibgen
