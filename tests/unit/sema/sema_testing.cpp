#include "sema_testing.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace rapid::sema::testing {

namespace fs = std::filesystem;

std::string readFile(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

std::span<const LibraryText> library() {
    struct Files {
        std::vector<std::pair<std::string, std::string>> files;
        std::vector<LibraryText> views;
        Files() {
            for (const char* folder : {"decl", "data"}) {
                const fs::path path = fs::path(RAPIDC_SOURCE_DIR) / "stdlib" / folder;
                std::error_code error;
                for (const auto& entry : fs::directory_iterator(path, error))
                    if (entry.path().extension() == ".sysx")
                        files.emplace_back(std::string(folder) + "/" + entry.path().filename().string(),
                                           readFile(entry.path().string()));
            }
            std::sort(files.begin(), files.end());
            for (const auto& [name, text] : files)
                views.push_back({name, text});
        }
    };
    static const Files all;
    return all.views;
}

std::vector<std::string> Checked::messages() const {
    std::vector<std::string> lines;
    for (const diag::Diagnostic& d : sink.sorted()) {
        if (d.severity == diag::Severity::Note) continue;
        std::string line = diag::codeName(d.code);
        if (d.file) {
            const LineColumn at = d.file->lineColumn(d.range.begin);
            line += " at " + std::to_string(at.line) + ":" + std::to_string(at.column);
        }
        lines.push_back(line + ": " + d.message);
    }
    return lines;
}

std::vector<std::string> Checked::codes() const {
    std::vector<std::string> names;
    for (const diag::Diagnostic& d : sink.sorted())
        if (d.severity != diag::Severity::Note) names.push_back(diag::codeName(d.code));
    return names;
}

std::unique_ptr<Checked> checkTasks(const std::vector<std::vector<std::string>>& tasks,
                                    CheckOptions options) {
    if (options.library.empty()) options.library = library();
    std::vector<TaskInput> inputs;
    for (size_t t = 0; t < tasks.size(); ++t) {
        TaskInput input;
        if (t > 0) input.name = "T_" + std::to_string(t + 1);
        for (size_t f = 0; f < tasks[t].size(); ++f)
            input.files.push_back(std::make_shared<const SourceFile>(
                "t" + std::to_string(t + 1) + "_" + std::to_string(f + 1) + ".modx", tasks[t][f]));
        inputs.push_back(std::move(input));
    }
    auto checked = std::make_unique<Checked>();
    checked->program = check(inputs, options, checked->sink);
    return checked;
}

std::unique_ptr<Checked> checkTexts(const std::vector<std::string>& texts, CheckOptions options) {
    return checkTasks({texts}, std::move(options));
}

const Symbol* findSymbol(const CheckedProgram& program, std::string_view name) {
    for (const Module* module : program.tasks.at(0)->modules) {
        for (const TypeSymbol* s : module->types)
            if (s->name == name) return s;
        for (const DataSymbol* s : module->data)
            if (s->name == name) return s;
        for (const RoutineSymbol* s : module->routines)
            if (s->name == name) return s;
    }
    return nullptr;
}

} // namespace rapid::sema::testing
