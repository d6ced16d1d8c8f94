#include "runtime/sim/stimulus.h"

#include "runtime/base/text_util.h"
#include "runtime/sim/surroundings.h"

#include <fmt/format.h>

#include <algorithm>

namespace rt {
namespace {

/// Splits a line at its first two commas; the third field is the rest. A field may stand in double quotes, with "" for one.
bool splitFields(std::string_view line, std::vector<std::string>& fields, std::string& error) {
    fields.clear();
    std::size_t i = 0;
    for (;;) {
        while (i < line.size() && (line[i] == ' ' || line[i] == '\t'))
            ++i;
        std::string field;
        if (i < line.size() && line[i] == '"') {
            for (++i;; ++i) {
                if (i >= line.size()) {
                    error = "no closing quotation mark";
                    return false;
                }
                if (line[i] != '"')
                    field += line[i];
                else if (i + 1 < line.size() && line[i + 1] == '"')
                    field += line[i++];
                else
                    break;
            }
            ++i;
            const std::string_view rest = trimmed(line.substr(i, line.find(',', i) - i));
            if (!rest.empty()) {
                error = fmt::format("unexpected '{}' after the closing quotation mark", rest);
                return false;
            }
            i = std::min(line.find(',', i), line.size());
        } else {
            const std::size_t end =
                fields.size() < 2 ? std::min(line.find(',', i), line.size()) : line.size();
            field = trimmed(line.substr(i, end - i));
            i = end;
        }
        fields.push_back(std::move(field));
        if (i >= line.size()) return true;
        ++i; // the comma
    }
}

/// Comments begin with # outside of quotation marks.
std::string_view withoutComment(std::string_view line) {
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"')
            quoted = !quoted;
        else if (line[i] == '#' && !quoted)
            return line.substr(0, i);
    }
    return line;
}

bool actionKind(std::string_view target, StimulusKind& kind) {
    static constexpr std::pair<const char*, StimulusKind> kActions[] = {
        {"answer", StimulusKind::Answer},
        {"stop", StimulusKind::Stop},
        {"quick_stop", StimulusKind::QuickStop},
        {"emergency_stop", StimulusKind::EmergencyStop},
        {"power_fail", StimulusKind::PowerFail},
        {"power_on", StimulusKind::PowerOn},
        {"start", StimulusKind::Start},
        {"pp_to_main", StimulusKind::PpToMain},
        {"step_forward", StimulusKind::StepForward},
        {"step_backward", StimulusKind::StepBackward},
        {"pendant_lost", StimulusKind::PendantLost},
        {"pendant_found", StimulusKind::PendantFound},
        {"views_full", StimulusKind::ViewsFull},
        {"views_free", StimulusKind::ViewsFree},
        {"device_lost", StimulusKind::DeviceLost},
        {"device_found", StimulusKind::DeviceFound},
        {"network_error", StimulusKind::NetworkError},
        {"network_ok", StimulusKind::NetworkOk},
        {"signal_invalid", StimulusKind::SignalInvalid},
        {"signal_valid", StimulusKind::SignalValid},
    };
    for (const auto& [name, value] : kActions) {
        if (target != name) continue;
        kind = value;
        return true;
    }
    return false;
}

/// TRUE and FALSE are welcome beside 1 and 0.
bool signalValue(std::string_view text, double& value) {
    if (sameName(text, "TRUE") || sameName(text, "high"))
        value = 1;
    else if (sameName(text, "FALSE") || sameName(text, "low"))
        value = 0;
    else
        return parseNumber(text, value);
    return true;
}

bool readItem(const std::vector<std::string>& fields, StimulusItem& item, std::string& error) {
    double seconds = 0;
    if (fields.size() < 2 || fields.size() > 3) {
        error = fmt::format("{} field(s); expected time_s,target,value", fields.size());
    } else if (!parseNumber(fields[0], seconds)) {
        error = fmt::format("'{}' is not a time in seconds", fields[0]);
    } else if (seconds < 0) {
        error = fmt::format("the time {} is negative; times count from the start of main", fields[0]);
    } else if (fields[1].empty()) {
        error = "no target; expected the name of a signal, 'answer' or a controller action";
    }
    if (!error.empty()) return false;
    const std::string value = fields.size() == 3 ? fields[2] : std::string();
    item.time = fromSeconds(seconds);
    item.target = fields[1];
    if (!actionKind(item.target, item.kind)) {
        const auto name = Surroundings::split(item.target);
        item.kind = name ? StimulusKind::Quantity : StimulusKind::Signal;
        if (name) error = Surroundings::problemOf(name->quantity);
        if (error.empty() && !signalValue(value, item.value))
            error = fmt::format("'{}' is not a value for {}{}", value, name ? "" : "signal ", item.target);
    } else if (item.kind == StimulusKind::Answer) {
        item.text = value;
    } else if (item.kind >= StimulusKind::DeviceLost) {
        item.text = value;
        if (value.empty()) error = fmt::format("the action {} needs a name as its value", item.target);
    } else if (!value.empty()) {
        error = fmt::format("the controller action {} takes no value, but '{}' is given", item.target, value);
    }
    return error.empty();
}

} // namespace

std::vector<StimulusItem> parseStimulus(std::string_view text, std::vector<StimulusProblem>& problems) {
    const std::string utf8 = toUtf8(text);
    const std::string_view all = utf8;
    std::vector<StimulusItem> items;
    std::vector<std::string> fields;
    uint32_t lineNumber = 0;
    bool headerAllowed = true;
    for (std::size_t begin = 0; begin < all.size();) {
        const std::size_t end = std::min(all.find('\n', begin), all.size());
        const std::string_view line = trimmed(withoutComment(all.substr(begin, end - begin)));
        begin = end + 1;
        ++lineNumber;
        if (line.empty()) continue;
        StimulusItem item;
        item.line = lineNumber;
        std::string error;
        const bool header = headerAllowed;
        headerAllowed = false;
        if (!splitFields(line, fields, error)) {
            problems.push_back({lineNumber, std::move(error)});
            continue;
        }
        if (header && (sameName(fields[0], "time_s") || sameName(fields[0], "time"))) continue;
        if (readItem(fields, item, error))
            items.push_back(std::move(item));
        else
            problems.push_back({lineNumber, std::move(error)});
    }
    // Lines of the same time keep their order.
    std::sort(items.begin(), items.end(), [](const StimulusItem& x, const StimulusItem& y) {
        return x.time != y.time ? x.time < y.time : x.line < y.line;
    });
    return items;
}

std::vector<StimulusItem> readStimulus(const std::string& path, std::vector<StimulusProblem>& problems) {
    std::string text;
    const std::string error = readStream(path, text);
    if (error.empty()) return parseStimulus(text, problems);
    problems.push_back({0, fmt::format("cannot be read: {}", error)});
    return {};
}

} // namespace rt
