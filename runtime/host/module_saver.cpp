#include "runtime/host/module_saver.h"

#include "runtime/base/text_util.h"
#include "runtime/host/controller.h"
#include "runtime/host/rapidc_process.h"
#include "runtime/value/value_text.h"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <set>

namespace rt {
namespace {

namespace fs = std::filesystem;

bool belongsTo(const GlobalDesc& data, int32_t task) {
    return task < 0 || data.task < 0 || data.task == task;
}

} // namespace

ModuleSaver::~ModuleSaver() = default;

void ModuleSaver::remember() {
    declared_.clear();
    const ProgramDesc& program = controller_.program();
    for (uint32_t i = 0; i < program.globalCount; ++i)
        remember(program.globals[i]);
    for (uint32_t i = 0; i < program.aliasCount; ++i)
        remember(program.aliases[i]);
}

void ModuleSaver::remember(const GlobalDesc& data) {
    if (data.kind != kGlobalPersistent || data.file == nullptr) return;
    declared_.push_back({&data, std::string(static_cast<const char*>(data.address), data.type->size)});
}

bool ModuleSaver::hasChanged(const Declared& declared, std::string& text) const {
    const GlobalDesc& data = *declared.data;
    if (std::memcmp(data.address, declared.bytes.data(), declared.bytes.size()) == 0) return false;
    std::string before; // unused bytes of strings and records do not count
    if (!valueToSource(data.address, *data.type, text)) {
        controller_.log().write(EventId::ValueNotSaved, nullptr,
                                {fmt::format("the value of {}.{} has no literal, it stays as it is in the "
                                             "source",
                                             data.module, data.name)});
        return false;
    }
    return !valueToSource(declared.bytes.data(), *data.type, before) || before != text;
}

std::string ModuleSaver::hostPath(const char* file) const {
    const ProgramDesc& program = controller_.program();
    const fs::path path(file);
    const bool known = program.folder != nullptr && *program.folder != '\0';
    return path.is_absolute() || !known ? path.string() : (fs::path(program.folder) / path).string();
}

/// As people are to read it: the folder of HOME: has another name in each run.
std::string ModuleSaver::shown(const std::string& path) const {
    std::error_code ignored;
    const std::string real = fs::weakly_canonical(path, ignored).string();
    const std::string& home = controller_.volumes().path();
    const bool inside =
        real.size() > home.size() && real.compare(0, home.size(), home) == 0 && real[home.size()] == '/';
    return inside ? "HOME:" + real.substr(home.size()) : path;
}

/// A program may write in HOME:; elsewhere only when the user allows it.
std::string ModuleSaver::defaultDestination(const std::string& source) const {
    if (controller_.options().save || shown(source).rfind("HOME:", 0) == 0) return source;
    std::string path;
    return controller_.volumes().resolve(fs::path(source).filename().string(), path) ? path : std::string();
}

/// A file may belong to several tasks, each of which has an object of its own (TASK PERS, LOCAL PERS): it can hold one value.
void ModuleSaver::reportOthers(const Declared& saved, const std::string& value) const {
    const GlobalDesc& data = *saved.data;
    const auto taskOf = [this](const GlobalDesc& row) {
        return row.task < 0 ? std::string("all tasks")
                            : controller_.tasks()[static_cast<std::size_t>(row.task)]->name();
    };
    for (const Declared& other : declared_) {
        const GlobalDesc& row = *other.data;
        std::string text;
        if (row.address == data.address || std::strcmp(row.name, data.name) != 0 ||
            std::strcmp(row.module, data.module) != 0 || hostPath(row.file) != hostPath(data.file) ||
            !valueToSource(row.address, *row.type, text) || text == value)
            continue;
        controller_.log().write(
            EventId::ValueNotSaved, nullptr,
            {fmt::format("{}.{} is {} in {}, which is saved, and {} in {}, which is not, because both tasks "
                         "use one file; give each task a file of its own",
                         data.module, data.name, value, taskOf(data), text, taskOf(row))});
    }
}

std::vector<ModuleSaver::Declared*> ModuleSaver::changedIn(const std::string& source, int32_t task,
                                                           ModuleText& text) {
    std::vector<Declared*> rows;
    std::set<std::pair<std::string, std::string>>
        named; // a file may belong to several tasks: the first one's values
    std::string value;
    for (Declared& declared : declared_) {
        const GlobalDesc& data = *declared.data;
        if (!belongsTo(data, task) || hostPath(data.file) != source || !hasChanged(declared, value)) continue;
        if (!named.insert({data.module, data.name}).second) continue;
        rows.push_back(&declared);
        reportOthers(declared, value);
        text.values.push_back({data.module, data.name, value});
    }
    return rows;
}

ModuleSaver::Result ModuleSaver::write(ModuleText& text, const std::vector<Declared*>& rows,
                                       const Task* task) {
    if (!store_) store_ = std::make_unique<RapidcProcess>();
    const StoreResult stored = store_->store(text);
    if (!stored.problem.empty()) return {Outcome::NotWritten, stored.problem};
    for (const std::string& note : stored.notes)
        controller_.log().write(EventId::ValueNotSaved, task, {note});
    if (text.source == text.destination)
        for (Declared* row : rows)
            row->bytes.assign(static_cast<const char*>(row->data->address), row->data->type->size);
    controller_.log().write(EventId::ModuleSaved, task, {shown(text.source), shown(text.destination)});
    return {};
}

/// The values of a module that was loaded meanwhile: the writer finds out what differs from its file.
void ModuleSaver::addUnit(const LoadedModule& module, ModuleText& text) const {
    for (uint32_t i = 0; i < module.unit->globalCount; ++i) {
        const GlobalDesc& data = module.unit->globals[i];
        std::string value;
        if (data.kind == kGlobalPersistent && sameName(data.module, module.name) &&
            valueToSource(data.address, *data.type, value))
            text.values.push_back({data.module, data.name, std::move(value)});
    }
}

ModuleSaver::Result ModuleSaver::save(const Task& task, std::string_view module,
                                      const std::string& destination) {
    const auto index = static_cast<int32_t>(task.index());
    const LoadedModule* found = controller_.tables().findModule(index, module);
    if (found == nullptr || found->file.empty())
        return {Outcome::NoModule, fmt::format("task {} has no module '{}'", task.name(), module)};
    ModuleText text;
    text.source = hostPath(found->file.c_str());
    text.destination = destination.empty() ? defaultDestination(text.source) : destination;
    if (text.destination.empty())
        return {Outcome::NotWritten, fmt::format("'{}' cannot be written in HOME:", text.source)};
    std::vector<Declared*> rows;
    if (found->unit != nullptr)
        addUnit(*found, text);
    else
        rows = changedIn(text.source, index, text);
    return write(text, rows, &task);
}

bool ModuleSaver::saveAll() {
    bool all = true;
    std::set<std::string> done;
    for (const Declared& declared : declared_) {
        ModuleText text;
        text.source = text.destination = hostPath(declared.data->file);
        if (!done.insert(text.source).second) continue;
        const auto rows = changedIn(text.source, -1, text);
        if (rows.empty()) continue;
        const Result result = write(text, rows, nullptr);
        if (result.outcome == Outcome::Saved) continue;
        controller_.log().write(EventId::ModuleNotSaved, nullptr, {shown(text.source), result.text});
        all = false;
    }
    return all;
}

} // namespace rt
