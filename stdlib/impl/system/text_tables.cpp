// Manual 1.17: texts of several languages, by number, from files that programs install.

#include "runtime/base/text_util.h"
#include "stdlib/impl/files/places.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/utf8.h"
#include "stdlib/impl/system/whole_file.h"

#include "natives/support.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <charconv>
#include <map>

using namespace rt;

namespace {

struct TextTable {
    std::string name;
    std::map<int, std::string> texts;
};

/// Numbers of tables that users install, in order. The lower ones belong to the system.
constexpr std::size_t kFirstTable = 1;
struct TextTables {
    std::vector<TextTable> tables;

    const TextTable* named(std::string_view name) const {
        for (const TextTable& table : tables)
            if (sameName(table.name, name)) return &table;
        return nullptr;
    }
};

TextTables& tablesOf(TaskCore* task) {
    return taskOf(task).controller().service<TextTables>();
}

bool readIndex(std::string_view text, int& index) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    return error == std::errc() && end == text.data() + text.size() && index >= 0;
}

/// "# comment", "name::", and pairs of lines: "1:" and the text.
std::string readPlain(std::string_view text, TextTable& table) {
    int index = -1;
    std::size_t number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = trimmed(text.substr(begin, end - begin));
        begin = end + 1;
        ++number;
        if (index >= 0) {
            if (!table.texts.emplace(index, line).second)
                return fmt::format("line {}: text {} is there twice", number, index);
            index = -1;
        } else if (line.empty() || line.front() == '#') {
            continue;
        } else if (line.ends_with("::") && table.name.empty()) {
            table.name = std::string(line.substr(0, line.size() - 2));
        } else if (table.name.empty()) {
            return fmt::format("line {}: expected the name of the table, such as 'my_texts::'", number);
        } else if (!line.ends_with(':') || !readIndex(line.substr(0, line.size() - 1), index)) {
            return fmt::format("line {}: expected the number of a text, such as '1:'", number);
        }
    }
    if (index >= 0) return fmt::format("text {} is missing at the end of the file", index);
    return table.name.empty() ? "it is empty" : "";
}

/// Characters that XML writes as names.
std::string plainText(std::string_view xml) {
    static constexpr std::pair<std::string_view, char> kNames[] = {
        {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}, {"&amp;", '&'}};
    std::string out;
    while (!xml.empty()) {
        bool named = false;
        for (const auto& [name, character] : kNames) {
            if (!xml.starts_with(name)) continue;
            out += character;
            xml.remove_prefix(name.size());
            named = true;
            break;
        }
        if (named) continue;
        out += xml.front();
        xml.remove_prefix(1);
    }
    return out;
}

/// The value of Name="..." in an opening tag; false when it has none.
bool nameIn(std::string_view tag, std::string_view& name) {
    const std::size_t begin = tag.find("Name=\"");
    if (begin == std::string_view::npos) return false;
    name = tag.substr(begin + 6);
    const std::size_t end = name.find('"');
    name = name.substr(0, end);
    return end != std::string_view::npos;
}

/// <Resource Name="..."> with <Text Name="1"><Value>...</Value></Text>.
std::string readXml(std::string_view text, TextTable& table) {
    std::string_view name;
    const std::size_t resource = text.find("<Resource");
    if (resource == std::string_view::npos ||
        !nameIn(text.substr(resource, text.find('>', resource) - resource), name))
        return "expected <Resource Name=\"...\">";
    table.name = std::string(name);
    std::size_t at = text.find("<Text ", resource);
    while (at != std::string_view::npos) {
        const std::size_t end = text.find("</Text>", at);
        if (end == std::string_view::npos) return "a <Text> has no </Text>";
        const std::string_view part = text.substr(at, end - at);
        int index = 0;
        if (!nameIn(part.substr(0, part.find('>')), name) || !readIndex(name, index))
            return "a <Text> has no number (Name=\"1\")";
        const std::size_t value = part.find("<Value>"), valueEnd = part.find("</Value>");
        if (value == std::string_view::npos || valueEnd == std::string_view::npos || valueEnd < value)
            return fmt::format("text {} has no <Value>", index);
        if (!table.texts.emplace(index, plainText(part.substr(value + 7, valueEnd - value - 7))).second)
            return fmt::format("text {} is there twice", index);
        at = text.find("<Text ", end);
    }
    return {};
}

} // namespace

extern "C" {

/// A file in the XML form or in the older form of lines.
Status rt_TextTabInstall(TaskCore* task, const String* File) {
    std::string bytes;
    const std::string path = lib::shown(File->view());
    if (const std::string problem = lib::readWhole(taskOf(task).controller(), File->view(), bytes);
        !problem.empty())
        return lib::fail(task, err::ERR_FILEOPEN, path + " cannot be read: " + problem);
    const std::string text = toUtf8(bytes);
    TextTable table;
    const bool xml = trimmed(text).starts_with('<');
    if (const std::string problem = xml ? readXml(text, table) : readPlain(text, table); !problem.empty())
        return lib::fail(task, err::ERR_SYNTAX, path + " is not a text table: " + problem);
    TextTables& tables = tablesOf(task);
    if (tables.named(table.name) != nullptr)
        return lib::fail(task, err::ERR_ARGVALERR,
                         "a text table named " + table.name +
                             " is installed already; ask TextTabFreeToUse first");
    tables.tables.push_back(std::move(table));
    return kOk;
}

Status rt_TextTabGet(TaskCore* task, float* result, const String* TableName) {
    const TextTables& tables = tablesOf(task);
    const TextTable* table = tables.named(TableName->view());
    if (table == nullptr)
        return lib::fail(task, err::ERR_TXTNOEXIST,
                         "there is no text table named " + std::string(TableName->view()) +
                             "; install it with TextTabInstall");
    *result = static_cast<float>(static_cast<std::size_t>(table - tables.tables.data()) + kFirstTable);
    return kOk;
}

Status rt_TextTabFreeToUse(TaskCore* task, bool* result, const String* TableName) {
    *result = tablesOf(task).named(TableName->view()) == nullptr;
    return kOk;
}

/// A text that is longer than a string is cut.
Status rt_TextGet(TaskCore* task, String* result, float Table, float Index) {
    const TextTables& tables = tablesOf(task);
    const float position = Table - static_cast<float>(kFirstTable);
    if (!(position >= 0 && position < static_cast<float>(tables.tables.size())))
        return lib::failWith(task, err::ERR_TXTNOEXIST,
                             "there is no text table {}; TextTabGet gives the number of an installed one",
                             static_cast<double>(Table));
    const TextTable& table = tables.tables[static_cast<std::size_t>(position)];
    const auto text =
        Index >= 0 && Index < 1e6F ? table.texts.find(static_cast<int>(Index)) : table.texts.end();
    if (text == table.texts.end())
        return lib::failWith(task, err::ERR_TXTNOEXIST, "text table {} has no text {}",
                             static_cast<double>(Table), static_cast<double>(Index));
    result->assign(lib::cutToString(text->second));
    return kOk;
}
}
