#include "tools/service/data_path.h"

#include "runtime/base/text_util.h"
#include "runtime/value/value_text.h"
#include "stdlib/impl/data/data_access.h"
#include "tools/service/virtual_controller.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <fmt/format.h>

namespace rapidc::service {

namespace {

using rt::sameName;

bool isName(std::string_view text) {
    return !text.empty() && text.size() <= 80 && text.find_first_of(" \t\r\n\"'<>") == std::string_view::npos;
}

/// Modules that a controller has and this one does not: what they declare is predefined here.
bool isSystemModule(std::string_view name) {
    return sameName(name, "BASE") || sameName(name, "user");
}

constexpr rt::TypeDesc kBasicTypes[] = {
    {"num", "num", rt::DescKind::Num, 4, 0, {}, nullptr, nullptr, nullptr},
    {"dnum", "dnum", rt::DescKind::Dnum, 8, 0, {}, nullptr, nullptr, nullptr},
    {"bool", "bool", rt::DescKind::Bool, 1, 0, {}, nullptr, nullptr, nullptr},
    {"string", "string", rt::DescKind::String, sizeof(rt::String), 0, {}, nullptr, nullptr, nullptr},
};

/// The type itself, that of its elements or of a component. Null: none has this name.
const rt::TypeDesc* typeInside(const rt::TypeDesc* type, std::string_view name) {
    if (type == nullptr) return nullptr;
    if (type->kind == rt::DescKind::Array) return typeInside(type->fields[0], name);
    if (sameName(type->name, name)) return type;
    if (type->kind != rt::DescKind::Record) return nullptr;
    for (uint32_t i = 0; i < type->count; ++i)
        if (const rt::TypeDesc* found = typeInside(type->fields[i], name)) return found;
    return nullptr;
}

const rt::GlobalDesc* findGlobal(const rt::ProgramTables& tables, const DataPath& path, int32_t task) {
    const rt::GlobalDesc* found = nullptr;
    if (!path.module.empty()) found = tables.findGlobal(path.name, path.module, task, true);
    if (found != nullptr) return found;
    if (!path.module.empty() && !isSystemModule(path.module)) return nullptr;
    found = tables.findGlobal(path.name, {}, task, false);
    if (!path.module.empty() && found != nullptr && (found->flags & rt::kDataPredefined) == 0) return nullptr;
    if (found == nullptr && path.module.empty()) found = tables.findGlobal(path.name, {}, task, true);
    return found;
}

/// The data of a routine that the task executes, innermost first.
rt::DebugVariable findLocal(rt::Controller& core, const rt::Task& task, const DataPath& path) {
    const rt::Debugger& debugger = core.debugger();
    for (const rt::DebugFrame& frame : debugger.frames(task)) {
        if (!sameName(frame.place.routine, path.routine) || !sameName(frame.place.module, path.module))
            continue;
        for (const rt::DebugVariable& local : debugger.locals(frame))
            if (sameName(local.name, path.name)) return local;
    }
    return {};
}

rt::DebugVariable findVariable(VirtualController& controller, const DataPath& path, std::string& problem) {
    rt::Controller& core = controller.core();
    const rt::Task* task = nullptr;
    if (!path.task.empty()) {
        task = core.findTask(path.task);
        if (task == nullptr) {
            problem = fmt::format("there is no task {}", path.task);
            return {};
        }
    }
    if (!path.routine.empty()) {
        const rt::DebugVariable local = task != nullptr ? findLocal(core, *task, path) : rt::DebugVariable{};
        if (local.type == nullptr)
            problem = fmt::format("routine {} does not execute, or has no such data", path.routine);
        return local;
    }
    const rt::ProgramTables& tables = core.tables();
    for (const auto& each : core.tasks()) { // without a task: shared data, which each of them sees
        if (task != nullptr && each.get() != task) continue;
        const rt::GlobalDesc* global = findGlobal(tables, path, static_cast<int32_t>(each->index()));
        const bool isShared =
            global != nullptr && (global->task < 0 || (global->flags & rt::kDataPredefined) != 0);
        if (global != nullptr && (task != nullptr || isShared)) return rt::dataOf(*global);
    }
    problem = fmt::format("there are no data {}", path.url());
    return {};
}

/// Walks along indices and components.
class PartWalk {
  public:
    explicit PartWalk(FoundData& at) : at_(at) {}

    bool walk(std::string_view part) {
        while (!part.empty() && at_.problem.empty()) {
            if (part.front() == '{')
                indices(part);
            else if (part.front() == '.')
                component(part);
            else
                at_.problem = "expected an index or a component";
        }
        return at_.problem.empty();
    }

  private:
    void indices(std::string_view& part) {
        const std::size_t end = part.find('}');
        std::vector<int32_t> list;
        if (end == std::string_view::npos || !read(part.substr(1, end - 1), list)) {
            at_.problem = "indices are whole numbers in braces: {1} or {2,3}";
            return;
        }
        part.remove_prefix(end + 1);
        for (std::size_t i = 0; i < list.size() && at_.problem.empty(); ++i)
            at_.dims.empty() ? numbered(list[i]) : row(list[i]);
    }
    static bool read(std::string_view text, std::vector<int32_t>& list) {
        for (;;) {
            const std::size_t comma = std::min(text.find(','), text.size());
            const std::string_view one = rt::trimmed(text.substr(0, comma));
            int32_t index = 0;
            const auto [stop, error] = std::from_chars(one.data(), one.data() + one.size(), index);
            if (error != std::errc() || stop != one.data() + one.size()) return false;
            list.push_back(index);
            if (comma == text.size()) return true;
            text.remove_prefix(comma + 1);
        }
    }
    void row(int32_t index) {
        if (index < 1 || index > at_.dims.front()) {
            at_.problem = fmt::format("index {} is outside 1 to {}", index, at_.dims.front());
            return;
        }
        at_.dims.erase(at_.dims.begin());
        at_.data = static_cast<char*>(at_.data) + static_cast<std::size_t>(index - 1) * at_.bytes();
    }
    void numbered(int32_t number) {
        const bool isRecord = at_.type->kind == rt::DescKind::Record;
        if (isRecord && number >= 1 && static_cast<uint32_t>(number) <= at_.type->count)
            take(static_cast<uint32_t>(number) - 1);
        else
            at_.problem = isRecord ? fmt::format("type {} has {} components", at_.type->name, at_.type->count)
                                   : "it is not an array";
    }
    void component(std::string_view& part) {
        part.remove_prefix(1);
        const std::size_t end = std::min(part.find_first_of(".{"), part.size());
        const std::string_view name = part.substr(0, end);
        part.remove_prefix(end);
        if (at_.dims.empty() && at_.type->kind == rt::DescKind::Record)
            for (uint32_t i = 0; i < at_.type->count; ++i)
                if (sameName(at_.type->fieldNames[i], name)) return take(i);
        at_.problem = fmt::format("type {} has no component {}", at_.type->name, name);
    }
    void take(uint32_t i) {
        at_.data = static_cast<char*>(at_.data) + at_.type->offsets[i];
        at_.type = at_.type->fields[i];
        flatten(at_);
    }

  public:
    /// A type that is an array becomes dimensions and the type of the elements.
    static void flatten(FoundData& at) {
        if (at.type->kind != rt::DescKind::Array) return;
        for (const int32_t dim : at.type->dims)
            if (dim > 0) at.dims.push_back(dim);
        at.type = at.type->fields[0];
    }

  private:
    FoundData& at_;
};

void writeValue(const char* data, const rt::TypeDesc& type, const int32_t* dim, const int32_t* end,
                std::string& out, bool& hasText) {
    if (dim == end) {
        std::string text;
        hasText = rt::valueToSource(data, type, text) && hasText;
        out += text;
        return;
    }
    std::size_t size = type.size;
    for (const int32_t* inner = dim + 1; inner != end; ++inner)
        size *= static_cast<std::size_t>(*inner);
    out += '[';
    for (int32_t i = 0; i < *dim; ++i) {
        if (i > 0) out += ',';
        writeValue(data + static_cast<std::size_t>(i) * size, type, dim + 1, end, out, hasText);
    }
    out += ']';
}

/// The elements of "[a,b,c]": commas inside brackets and strings do not divide. False: it is no such text.
bool elementsOf(std::string_view text, std::vector<std::string_view>& elements) {
    text = rt::trimmed(text);
    if (text.size() < 2 || text.front() != '[' || text.back() != ']') return false;
    text = text.substr(1, text.size() - 2);
    int depth = 0;
    bool inString = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') inString = !inString;
        if (inString) continue;
        depth += c == '[' ? 1 : c == ']' ? -1 : 0;
        if (depth < 0) return false;
        if (c != ',' || depth > 0) continue;
        elements.push_back(text.substr(begin, i - begin));
        begin = i + 1;
    }
    elements.push_back(text.substr(begin));
    return depth == 0 && !inString;
}

bool readValue(std::string_view text, char* data, const rt::TypeDesc& type, const int32_t* dim,
               const int32_t* end) {
    if (dim == end) return rt::sourceToValue(rt::trimmed(text), data, type);
    std::vector<std::string_view> elements;
    if (!elementsOf(text, elements) || elements.size() != static_cast<std::size_t>(*dim)) return false;
    std::size_t size = type.size;
    for (const int32_t* inner = dim + 1; inner != end; ++inner)
        size *= static_cast<std::size_t>(*inner);
    for (std::size_t i = 0; i < elements.size(); ++i)
        if (!readValue(elements[i], data + i * size, type, dim + 1, end)) return false;
    return true;
}

std::string typeText(const rt::TypeDesc& type, const std::vector<int32_t>& dims) {
    std::string text = type.name;
    for (std::size_t i = 0; i < dims.size(); ++i)
        text += fmt::format("{}{}", i == 0 ? '{' : ',', dims[i]);
    return dims.empty() ? text : text + "}";
}

/// "" or what is wrong.
std::string readAll(std::string_view text, std::vector<char>& bytes, const rt::TypeDesc& type,
                    const std::vector<int32_t>& dims) {
    if (!readValue(text, bytes.data(), type, dims.data(), dims.data() + dims.size()))
        return fmt::format("the text is not a value of type {}", typeText(type, dims));
    std::string problem;
    for (std::size_t at = 0; at < bytes.size() && problem.empty(); at += type.size)
        problem = rt::rangeProblem(bytes.data() + at, type);
    return problem;
}

} // namespace

std::optional<DataPath> DataPath::read(std::string_view text) {
    std::vector<std::string> names = rapid::config::splitPath(text);
    if (!names.empty() && sameName(names.front(), "RAPID")) names.erase(names.begin());
    if (names.empty() || names.size() > 4) return std::nullopt;
    DataPath path;
    const std::string last = names.back();
    const std::size_t end = std::min(last.find_first_of("{."), last.size());
    path.name = last.substr(0, end);
    path.part = last.substr(end);
    names.pop_back();
    if (!isName(path.name) || !std::all_of(names.begin(), names.end(), isName)) return std::nullopt;
    if (!names.empty()) path.task = names[0];
    if (names.size() > 1) path.module = names[1];
    if (names.size() > 2) path.routine = names[2];
    return path;
}

std::string DataPath::url() const {
    std::string text = "RAPID";
    for (const std::string* each : {&task, &module, &routine})
        if (!each->empty()) text += "/" + *each;
    return text + "/" + name + part;
}

std::size_t FoundData::bytes() const {
    std::size_t size = type->size;
    for (const int32_t dim : dims)
        size *= static_cast<std::size_t>(dim);
    return size;
}

FoundData findData(VirtualController& controller, const DataPath& path) {
    FoundData found;
    const rt::DebugVariable variable = findVariable(controller, path, found.problem);
    if (!found.problem.empty()) return found;
    if (variable.data == nullptr) {
        found.problem = fmt::format("parameter {} is not present", path.name);
        return found;
    }
    found.data = variable.data;
    found.type = variable.type;
    found.isConstant = variable.isConstant;
    found.isPersistent = variable.isPersistent;
    found.isProtected = !rt::lib::writeProtection(variable).empty();
    found.dims.assign(variable.dims, variable.dims + variable.rank);
    PartWalk::flatten(found);
    if (!PartWalk(found).walk(path.part)) {
        found.problem = fmt::format("{}: {}", path.url(), found.problem);
        found.data = nullptr;
    }
    return found;
}

const rt::TypeDesc* typeNamed(VirtualController& controller, std::string_view name) {
    for (const rt::TypeDesc& type : kBasicTypes)
        if (sameName(type.name, name)) return &type;
    for (const rt::GlobalDesc* global : controller.core().tables().globals())
        if (const rt::TypeDesc* found = typeInside(global->type, name)) return found;
    return nullptr;
}

std::optional<std::string> valueOf(const FoundData& found) {
    std::string text;
    bool hasText = true;
    writeValue(static_cast<const char*>(found.data), *found.type, found.dims.data(),
               found.dims.data() + found.dims.size(), text, hasText);
    // a number that is not finite has no literal, but people may see it
    const bool isOpaque = found.type->kind == rt::DescKind::Handle ||
                          found.type->kind == rt::DescKind::Bytes || found.type->kind == rt::DescKind::Other;
    return isOpaque ? std::nullopt : std::optional(text);
}

std::string assign(const FoundData& found, std::string_view text) {
    if (found.isConstant) return "constants cannot be changed";
    if (found.isProtected) return "it belongs to the system and cannot be changed";
    std::vector<char> bytes(found.bytes());
    std::memcpy(bytes.data(), found.data, bytes.size());
    std::string problem = readAll(text, bytes, *found.type, found.dims);
    if (problem.empty()) std::memcpy(found.data, bytes.data(), bytes.size());
    return problem;
}

std::string checkValue(const rt::TypeDesc& type, const std::vector<int32_t>& dims, std::string_view text) {
    FoundData shape;
    shape.type = &type;
    shape.dims = dims;
    std::vector<char> bytes(shape.bytes());
    return readAll(text, bytes, type, dims);
}

} // namespace rapidc::service
