#include "runtime/report/recording.h"

#include "config/letter_case.h"
#include "runtime/base/text_util.h"
#include "runtime/robot/angles.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <optional>

namespace rt::report {
namespace {

/// The meaning of a column: its place in the list below, and what makes s, deg, mm of its numbers.
enum ColumnKind { kTime, kJoint1, kX = kJoint1 + 6, kUnit = kX + 3, kColumnKinds };

struct Column {
    int kind = -1;
    double factor = 1;
};

/// "TCP pos X [mm]" as "tcpposx", and the unit in brackets or after the last underline.
struct Header {
    std::string name, unit;

    explicit Header(std::string_view text) {
        std::string* into = &name;
        for (const char c : text) {
            if (c == '[' || c == '(') into = &unit;
            if (std::isalnum(static_cast<unsigned char>(c)) != 0 || (c == '_' && into == &name))
                *into += rapid::config::lowerLetter(c);
        }
        const std::size_t underline = name.rfind('_');
        for (const char* known : {"s", "ms", "mm", "m", "deg", "rad"}) {
            if (underline == std::string::npos || underline == 0 || name.substr(underline + 1) != known)
                continue;
            unit = known;
            name.resize(underline);
            break;
        }
        std::erase(name, '_');
    }
};

bool isOneOf(std::string_view name, std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

Column columnOf(std::string_view text) {
    const Header header(text);
    if (isOneOf(header.name, {"time", "t", "timestamp", "seconds", "sec"}))
        return {kTime, header.unit == "ms" ? 0.001 : 1};
    if (isOneOf(header.name, {"unit", "robot", "mechunit", "mechanicalunit"})) return {kUnit, 1};
    if (header.name.empty()) return {};
    const char last = header.name.back();
    const std::string_view stem = std::string_view(header.name).substr(0, header.name.size() - 1);
    if (last >= '1' && last <= '6' &&
        isOneOf(stem, {"j", "joint", "axis", "a", "rax", "robax", "jointangle"}))
        return {kJoint1 + (last - '1'), header.unit == "rad" ? robot::kDegreesPerRadian : 1};
    if (last >= 'x' && last <= 'z' && isOneOf(stem, {"", "tcp", "pos", "tcppos", "position", "trans"}))
        return {kX + (last - 'x'), header.unit == "m" ? 1000.0 : 1};
    return {};
}

std::vector<std::string_view> split(std::string_view line, char separator) {
    std::vector<std::string_view> fields;
    for (;;) {
        const std::size_t end = line.find(separator);
        std::string_view field = trimmed(line.substr(0, end));
        if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
            field = field.substr(1, field.size() - 2);
        fields.push_back(field);
        if (end == std::string_view::npos) return fields;
        line.remove_prefix(end + 1);
    }
}

class Reader {
  public:
    Reader(const std::string& file, std::vector<Recording>& recordings)
        : file_(file), recordings_(recordings) {}

    /// Returns the mistake in the text; empty: none.
    std::string read(std::string_view text) {
        if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
        while (!text.empty()) {
            const std::size_t end = text.find('\n');
            ++line_;
            const std::string_view line = trimmed(text.substr(0, end));
            text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
            if (line.empty() || line.front() == '#') continue;
            const std::string problem = columns_.empty() ? takeHeader(line) : takeRow(line);
            if (!problem.empty()) return fmt::format("{}:{}: {}", file_, line_, problem);
        }
        if (columns_.empty()) return fmt::format("{}: the file is empty; {}", file_, kRemedy);
        if (recordings_.empty()) ofUnit({});
        for (const Recording& recording : recordings_) {
            if (recording.samples.size() >= 2) continue;
            const std::string of = recording.unit.empty() ? "" : " of " + recording.unit;
            return fmt::format("{}: a recording{} needs two samples at least, this one has {}", file_, of,
                               recording.samples.size());
        }
        return {};
    }

  private:
    static constexpr const char* kRemedy =
        "the first line must name the columns: time_s, and j1 to j6 (degrees) or x, y, z (mm, TCP in world)";

    std::string takeHeader(std::string_view line) {
        for (const char separator : {';', '\t', ','}) {
            separator_ = separator;
            if (line.find(separator) != std::string_view::npos) break;
        }
        std::array<int, kColumnKinds> count{};
        for (const std::string_view name : split(line, separator_)) {
            names_.emplace_back(name);
            columns_.push_back(columnOf(name));
            const int kind = columns_.back().kind;
            if (kind < 0) continue;
            if (++count[static_cast<std::size_t>(kind)] > 1)
                return fmt::format("column '{}' means the same as a column before it; remove one of them",
                                   name);
        }
        if (count[kTime] == 0) return fmt::format("a column of time is missing; {}", kRemedy);
        const auto all = [&count](int from, int to) {
            return std::all_of(count.begin() + from, count.begin() + to, [](int n) { return n == 1; });
        };
        hasJoints_ = all(kJoint1, kX);
        hasPositions_ = all(kX, kUnit);
        if (!hasJoints_ && !hasPositions_)
            return fmt::format("neither j1 to j6 nor x, y, z are there in full; {}", kRemedy);
        return {};
    }

    std::string takeRow(std::string_view line) {
        const std::vector<std::string_view> fields = split(line, separator_);
        if (fields.size() < columns_.size())
            return fmt::format("{} fields instead of {}; is the line cut off?", fields.size(),
                               columns_.size());
        std::array<double, kColumnKinds> values{};
        std::string_view unit;
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            if (columns_[i].kind == kUnit) unit = fields[i];
            if (columns_[i].kind < 0 || columns_[i].kind == kUnit) continue;
            double value = 0;
            if (!number(fields[i], value))
                return fmt::format("'{}' in column '{}' is not a number; correct it or remove the line",
                                   fields[i], names_[i]);
            values[static_cast<std::size_t>(columns_[i].kind)] = value * columns_[i].factor;
        }
        RecordedSample sample;
        sample.time = values[kTime];
        std::copy_n(values.begin() + kJoint1, 6, sample.joints.begin());
        sample.position = {values[kX], values[kX + 1], values[kX + 2]};
        std::vector<RecordedSample>& samples = ofUnit(unit).samples;
        if (!samples.empty() && sample.time < samples.back().time)
            return fmt::format(
                "the time {} s is before that of the line above it ({} s); sort the lines by time",
                sample.time, samples.back().time);
        samples.push_back(sample);
        return {};
    }

    Recording& ofUnit(std::string_view unit) {
        for (Recording& recording : recordings_)
            if (sameName(recording.unit, unit)) return recording;
        recordings_.push_back({file_, std::string(unit), hasPositions_, hasJoints_, {}});
        return recordings_.back();
    }

    bool number(std::string_view field, double& value) const {
        if (separator_ == ',' || field.find(',') == std::string_view::npos) return parseNumber(field, value);
        std::string text(field);
        std::replace(text.begin(), text.end(), ',', '.');
        return parseNumber(text, value);
    }

    const std::string& file_;
    std::vector<Recording>& recordings_;
    bool hasJoints_ = false, hasPositions_ = false;
    std::size_t line_ = 0;
    char separator_ = ',';
    std::vector<Column> columns_;
    std::vector<std::string> names_;
};

} // namespace

std::string parseRecording(std::string_view text, const std::string& file,
                           std::vector<Recording>& recordings) {
    recordings.clear();
    return Reader(file, recordings).read(text);
}

std::string readRecording(const std::string& file, std::vector<Recording>& recordings) {
    std::string text;
    const std::string problem = readStream(file, text);
    if (!problem.empty()) return fmt::format("'{}' cannot be read: {}", file, problem);
    return parseRecording(text, file, recordings);
}

std::vector<const Recording*> recordingsFor(const std::vector<RobotRecord>& robots,
                                            const std::vector<Recording>& recordings) {
    std::vector<const Recording*> result;
    for (const RobotRecord& robot : robots) {
        const auto found =
            std::find_if(recordings.begin(), recordings.end(),
                         [&](const Recording& recording) { return sameName(recording.unit, robot.unit); });
        result.push_back(found == recordings.end() ? nullptr : &*found);
    }
    if (recordings.size() == 1 && !robots.empty() && (recordings.front().unit.empty() || robots.size() == 1))
        result.front() = &recordings.front();
    return result;
}

} // namespace rt::report
