// How long a session takes for a one-line edit: opens every module of a folder and edits one of them, line by line.
//
//   recheck_bench FOLDER FILE [EDITS]
//
// Prints one line for run_bench.py: lines of the file, of all files, median and worst processor time in ms, for edits in
// the bodies of routines and for edits that other files can see.

#include "frontend/sema/session.h"
#include "stdlib/stdlib_text.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

namespace {

namespace fs = std::filesystem;

std::string readFile(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return std::move(text).str();
}

double milliseconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) / 1e6;
}

struct Times {
    std::vector<double> all;
    double median() {
        std::sort(all.begin(), all.end());
        return all.empty() ? 0 : all[all.size() / 2];
    }
    double worst() const { return all.empty() ? 0 : *std::max_element(all.begin(), all.end()); }
};

/// Starts of the lines of `text` that begin with `word` after white space.
std::vector<size_t> linesWith(const std::string& text, const std::string& word) {
    std::vector<size_t> found;
    for (size_t line = 0; line < text.size();) {
        const size_t word_at = text.find_first_not_of(" \t", line);
        if (word_at != std::string::npos && text.compare(word_at, word.size(), word) == 0)
            found.push_back(line);
        const size_t end = text.find('\n', line);
        line = end == std::string::npos ? text.size() : end + 1;
    }
    return found;
}

} // namespace

int main(int count, char** arguments) {
    if (count < 3) return 1;
    const int edits = count > 3 ? std::atoi(arguments[3]) : 100;
    std::vector<rapid::sema::LibraryText> library;
    for (const rapid::stdlib::StdlibSource& source : rapid::stdlib::sources())
        library.push_back({source.name, source.text});
    rapid::sema::CheckOptions options;
    options.library = library;
    rapid::sema::TaskInput input;
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(arguments[1]))
        paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    size_t lines = 0;
    for (const fs::path& path : paths) {
        input.files.push_back(std::make_shared<const rapid::SourceFile>(path.string(), readFile(path)));
        lines += input.files.back()->lineCount();
    }
    rapid::sema::Session session(options);
    session.open({input});

    const std::string path = arguments[2];
    const std::string text = readFile(path);
    std::mt19937 random(1);
    const auto run = [&](const std::string& word, const std::string& inserted) {
        Times times;
        const std::vector<size_t> places = linesWith(text, word);
        for (int i = 0; i < edits && !places.empty(); ++i) {
            std::string now = text;
            now.insert(places[random() % places.size()], inserted);
            const double start = milliseconds();
            session.change(std::make_shared<const rapid::SourceFile>(path, std::move(now)));
            times.all.push_back(milliseconds() - start);
        }
        return times;
    };
    Times body = run("Move", "  TPWrite \"edited\";\n");
    Times visible = run("PROC", "  CONST num edited := 1;\n");
    const auto fileLines = static_cast<size_t>(std::count(text.begin(), text.end(), '\n'));
    std::printf("%zu %zu %.2f %.2f %.2f %.2f\n", fileLines, lines, body.median(), body.worst(),
                visible.median(), visible.worst());
    return session.diagnostics().empty() ? 0 : 2;
}
