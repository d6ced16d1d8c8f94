#include "frontend/diag/catalogue.h"
#include "frontend/diag/messages/syntax.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <tuple>
#include <utility>

namespace rapid::diag {

namespace {

/// White space would not be visible in a message.
std::string quoted(std::string_view text) {
    constexpr size_t kLongest = 40;
    if (text.size() > kLongest || text.find_first_of("\r\n\t") != std::string_view::npos) return "this";
    return fmt::format("'{}'", text);
}

std::string_view withoutSpaces(std::string_view text) {
    while (!text.empty() && text.front() == ' ')
        text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ')
        text.remove_suffix(1);
    return text;
}

} // namespace

CauseId newLineCause() {
    constexpr uint32_t kLineCauses = 1u << 31; // those of a check are smaller
    static std::atomic<uint32_t> last = 0;
    return CauseId{kLineCauses | ++last};
}

Diagnostic& Diagnostic::fix(SourceRange place, std::string replacement, bool certain) {
    const std::string_view old =
        file ? file->text().substr(place.begin, place.end - place.begin) : std::string_view();
    const std::string_view fresh = withoutSpaces(replacement);
    // Spaces of other kinds look like plain ones.
    const bool odd = std::all_of(old.begin(), old.end(), [](char c) { return (c & 0x80) != 0; });
    std::string words = old.empty()     ? "insert " + quoted(fresh)
                        : fresh.empty() ? !odd || replacement.empty() ? "remove " + quoted(withoutSpaces(old))
                                                                      : "write a plain space"
                                        : fmt::format("replace {} with {}", quoted(old), quoted(fresh));
    Fix one;
    one.message = std::move(words);
    one.certain = certain;
    one.edits.push_back({place, std::move(replacement)});
    fixes.push_back(std::move(one));
    return *this;
}

Diagnostic& Sink::report(Code code, const std::shared_ptr<const SourceFile>& file, SourceRange range,
                         std::span<const std::string> args) {
    const CatalogueEntry* entry = findEntry(static_cast<uint16_t>(code));
    const Severity severity = entry ? entry->severity : Severity::Error;
    if (severity == Severity::Error) ++errorCount_;
    if (code != say::TooManyErrors.code && isOneTooMany(file, range, severity))
        return dropped_ = Diagnostic();
    Diagnostic& diagnostic = all_.emplace_back();
    diagnostic.code = code;
    diagnostic.severity = severity;
    diagnostic.file = file;
    diagnostic.range = range;
    if (entry) diagnostic.message = formatText(entry->text, args);
    diagnostic.args.assign(args.begin(), args.end());
    return diagnostic;
}

bool Sink::isOneTooMany(const std::shared_ptr<const SourceFile>& file, SourceRange range, Severity severity) {
    Kept& kept = kept_[file.get()];
    const bool error = severity == Severity::Error;
    uint32_t& count = error ? kept.errors : kept.warnings;
    if (count < kMaxPerFile) {
        ++count;
        return false;
    }
    if (count == kMaxPerFile) {
        ++count;
        report(say::TooManyErrors.code, file, range, {error ? "errors" : "warnings"});
    }
    return true;
}

void Sink::revise(const std::function<bool(Diagnostic&)>& keep) {
    std::erase_if(all_, [&](Diagnostic& d) { return !keep(d); });
    errorCount_ = static_cast<size_t>(std::count_if(
        all_.begin(), all_.end(), [](const Diagnostic& d) { return d.severity == Severity::Error; }));
}

void Sink::retract(const std::function<bool(const Diagnostic&)>& wrong) {
    std::erase_if(all_, [&](const Diagnostic& d) {
        if (d.severity != Severity::Error || !wrong(d)) return false;
        --errorCount_;
        if (const auto kept = kept_.find(d.file.get()); kept != kept_.end() && kept->second.errors > 0)
            --kept->second.errors;
        return true;
    });
}

std::vector<Diagnostic> Sink::take() {
    errorCount_ = 0;
    kept_.clear();
    return std::exchange(all_, {});
}

void Sink::add(std::span<const Diagnostic> diagnostics) {
    for (const Diagnostic& d : diagnostics)
        if (d.severity == Severity::Error) ++errorCount_;
    all_.insert(all_.end(), diagnostics.begin(), diagnostics.end());
}

void Sink::absorb(Sink& other) {
    for (Diagnostic& d : other.all_) {
        if (d.severity == Severity::Error) ++errorCount_;
        if (d.code == say::TooManyErrors.code || !isOneTooMany(d.file, d.range, d.severity))
            all_.push_back(std::move(d));
    }
    other.take();
}

std::vector<Diagnostic> Sink::sorted() const {
    // A "too many errors" note is about the whole file and stays after its last error.
    const auto key = [this](size_t i) {
        const Diagnostic& d = all_[i];
        return std::make_tuple(d.file ? std::string_view(d.file->path()) : std::string_view(),
                               d.code == say::TooManyErrors.code, d.range.begin, d.range.end,
                               static_cast<uint16_t>(d.code), i);
    };
    std::vector<size_t> order(all_.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return key(a) < key(b); });
    std::vector<Diagnostic> result;
    result.reserve(all_.size());
    for (const size_t i : order) {
        // A module that several tasks share is checked in each of them; its mistakes are reported once.
        const Diagnostic& d = all_[i];
        const bool again = !result.empty() && d.file && result.back().file && d.code == result.back().code &&
                           d.range == result.back().range && d.message == result.back().message &&
                           d.file->path() == result.back().file->path();
        if (!again) result.push_back(d);
    }
    return result;
}

std::string codeName(Code code) {
    return fmt::format("RAP{:04}", static_cast<unsigned>(code));
}

std::string_view severityName(Severity severity) {
    switch (severity) {
    case Severity::Error: return "error";
    case Severity::Warning: return "warning";
    case Severity::Note: return "note";
    }
    return "error";
}

} // namespace rapid::diag
