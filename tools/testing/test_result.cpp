#include "tools/testing/test_result.h"

#include "config/text_util.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace testing {
namespace {

constexpr uint32_t kFormat =
    0x54455354; // both processes are of one executable: no more than a check that it is whole

class Writer {
  public:
    void number(uint64_t value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }
    void text(const std::string& value) {
        number(value.size());
        bytes_ += value;
    }
    void spot(const Spot& value) {
        text(value.file);
        text(value.module);
        text(value.routine);
        number(value.line);
        number(value.column);
    }
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

class Reader {
  public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}

    uint64_t number() {
        uint64_t value = 0;
        if (bytes_.size() < sizeof value) {
            isWhole_ = false;
            return 0;
        }
        std::memcpy(&value, bytes_.data(), sizeof value);
        bytes_.remove_prefix(sizeof value);
        return value;
    }
    std::string text() {
        const uint64_t size = number();
        if (size > bytes_.size()) {
            isWhole_ = false;
            return {};
        }
        std::string value(bytes_.substr(0, size));
        bytes_.remove_prefix(size);
        return value;
    }
    Spot spot() {
        Spot value;
        value.file = text();
        value.module = text();
        value.routine = text();
        value.line = static_cast<uint32_t>(number());
        value.column = static_cast<uint32_t>(number());
        return value;
    }
    bool isWhole() const { return isWhole_; }
    bool isAtEnd() const { return bytes_.empty(); }

  private:
    std::string_view bytes_;
    bool isWhole_ = true;
};

void decodeLines(std::string& text) {
    std::string decoded;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
        decoded += rapid::config::toUtf8(std::string_view(text).substr(begin, end - begin));
        begin = end;
    }
    text = std::move(decoded);
}

} // namespace

const char* nameOf(Outcome outcome) {
    switch (outcome) {
    case Outcome::Passed: return "passed";
    case Outcome::Failed: return "failed";
    case Outcome::Error: return "error";
    case Outcome::Timeout: return "timeout";
    case Outcome::Skipped: return "skipped";
    }
    return "";
}

std::string Spot::text() const {
    const std::string& where = file.empty() ? module : file;
    if (where.empty() || line == 0) return where;
    return fmt::format("{}:{}", where, line);
}

TestResult inUtf8(TestResult result) {
    for (std::string* text :
         {&result.message, &result.expected, &result.actual, &result.output, &result.events})
        decodeLines(*text);
    return result;
}

std::string pack(const TestResult& result) {
    Writer out;
    out.number(kFormat);
    out.number(static_cast<uint64_t>(result.outcome));
    out.spot(result.spot);
    out.text(result.message);
    out.text(result.expected);
    out.text(result.actual);
    out.number(result.assertions);
    out.number(static_cast<uint64_t>(result.virtualTime));
    out.number(result.calls.size());
    for (const Spot& call : result.calls)
        out.spot(call);
    out.number(result.executed.size());
    for (const auto& [place, count] : result.executed) {
        out.number(place.first);
        out.number(place.second);
        out.number(count);
    }
    out.number(kFormat);
    return out.take();
}

bool unpack(std::string_view bytes, TestResult& result) {
    Reader in(bytes);
    if (in.number() != kFormat) return false;
    result.outcome = static_cast<Outcome>(in.number());
    result.spot = in.spot();
    result.message = in.text();
    result.expected = in.text();
    result.actual = in.text();
    result.assertions = in.number();
    result.virtualTime = static_cast<int64_t>(in.number());
    for (uint64_t left = in.number(); left > 0 && in.isWhole(); --left)
        result.calls.push_back(in.spot());
    for (uint64_t left = in.number(); left > 0 && in.isWhole(); --left) {
        const auto routine = static_cast<uint32_t>(in.number()),
                   statement = static_cast<uint32_t>(in.number());
        result.executed[{routine, statement}] = in.number();
    }
    return in.number() == kFormat && in.isWhole() && in.isAtEnd();
}

} // namespace testing
