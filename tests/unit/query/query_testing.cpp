#include "query_testing.h"

#include <catch2/catch.hpp>

namespace rapid::query::testing {

MarkedText withoutMarkers(std::string_view text) {
    MarkedText result;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '$' && i + 1 < text.size() && text[i + 1] >= '1' && text[i + 1] <= '9')
            result.places[text[++i] - '0'] = static_cast<uint32_t>(result.text.size());
        else
            result.text += text[i];
    }
    return result;
}

Program::Program(std::vector<std::string> texts, std::vector<std::string> configuration,
                 sema::CheckOptions options)
    : options_(std::move(options)) {
    open({std::move(texts)}, std::move(configuration));
}

Program Program::ofTasks(std::vector<std::vector<std::string>> tasks) {
    Program program;
    program.open(std::move(tasks), {});
    return program;
}

void Program::open(std::vector<std::vector<std::string>> tasks, std::vector<std::string> configuration) {
    options_.library = sema::testing::library();
    std::map<std::string, std::shared_ptr<const SourceFile>> shared;
    for (size_t t = 0; t < tasks.size(); ++t) {
        sema::TaskInput input;
        if (t > 0) input.name = "T_" + std::to_string(t + 1);
        for (size_t f = 0; f < tasks[t].size(); ++f) {
            // Equal texts are one file that several tasks load.
            auto& file = shared[tasks[t][f]];
            if (!file) {
                const MarkedText marked = withoutMarkers(tasks[t][f]);
                const std::string path = "t" + std::to_string(t + 1) + "_" + std::to_string(f + 1) + ".modx";
                for (const auto& [marker, offset] : marked.places)
                    places_[marker] = {path, offset};
                file = std::make_shared<const SourceFile>(path, marked.text);
            }
            input.files.push_back(file);
        }
        tasks_.push_back(std::move(input));
    }
    std::vector<std::shared_ptr<const SourceFile>> texts;
    for (const std::string& text : configuration) {
        const MarkedText marked = withoutMarkers(text);
        const std::string path = "EIO" + std::to_string(texts.size()) + ".cfg";
        for (const auto& [marker, offset] : marked.places)
            places_[marker] = {path, offset};
        texts.push_back(std::make_shared<const SourceFile>(path, marked.text));
    }
    checked_ = std::make_unique<sema::testing::Checked>();
    checked_->program = sema::check(tasks_, options_, checked_->sink);
    snapshot_ = std::make_unique<Snapshot>(*checked_->program, std::move(texts));
}

const FileView& Program::file(int marker) const {
    const FileView* found = snapshot_->file(places_.at(marker).first);
    REQUIRE(found);
    return *found;
}

std::string inMain(std::string_view body, std::string_view declarations) {
    return "MODULE m\n" + std::string(declarations) + "\nPROC main()\n" + std::string(body) +
           "\nENDPROC\nENDMODULE\n";
}

} // namespace rapid::query::testing
