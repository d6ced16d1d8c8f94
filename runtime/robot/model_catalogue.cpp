// Finds robot models by the many ways people and controllers spell them.

#include "runtime/robot/embedded_models.h"
#include "runtime/robot/lengths.h"
#include "runtime/robot/robot_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>

namespace robot {

namespace {

/// A name taken apart: "IRB 1660ID-4/1.55" -> series "irb", family "1660id", details "4", "1.55".
struct NameParts {
    std::string series;
    std::string family;
    std::vector<std::string> details; // payload, reach and suffixes, in any order
    std::string side;                 // "l" or "r": the arm of a robot that has two
};

bool isNameCharacter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.';
}

std::vector<std::string> tokens(std::string_view name) {
    std::vector<std::string> result;
    std::string token;
    for (char c : name) {
        if (isNameCharacter(c))
            token += static_cast<char>(
                std::tolower(static_cast<unsigned char>(c))); // this layer includes no other
        else if (!token.empty())
            result.push_back(std::exchange(token, {}));
    }
    if (!token.empty()) result.push_back(token);
    return result;
}

/// ROB1, ROB_2 ... in front of use_robot_type count for nothing.
bool isMechanicalUnit(const std::string& token) {
    return token.rfind("rob", 0) == 0 &&
           std::all_of(token.begin() + 3, token.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// "TypeB", as in ROB1_1200_0.9_5_TypeB: a later edition of the arm with the same axes.
bool isEdition(const std::string& token) {
    return token.size() == 5 && token.rfind("type", 0) == 0;
}

/// "05", as in ROB_R_14000_05_05_TYPEA: 0.5.
bool isFigureWithoutPoint(const std::string& token) {
    return token.size() > 1 && token.front() == '0' &&
           std::all_of(token.begin(), token.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

NameParts takeApart(std::string_view name) {
    NameParts parts;
    bool isUnitNumber = false; // ROB_1, Type B
    for (std::string token : tokens(name)) {
        if (isUnitNumber && (token == "l" || token == "r")) parts.side = token; // ROB_R_14000
        const bool skip = isMechanicalUnit(token) || isEdition(token) || token == "type" ||
                          (isUnitNumber && token.size() == 1);
        isUnitNumber = token == "rob" || token == "type";
        if (skip) continue;
        for (std::string_view series : {"irb", "crb"}) {
            if (parts.family.empty() && token.rfind(series, 0) == 0) {
                parts.series = series;
                token.erase(0, series.size());
            }
        }
        if (token.empty()) continue;
        if (parts.family.empty())
            parts.family = token;
        else if (isFigureWithoutPoint(token))
            parts.details.push_back("0." + token.substr(1));
        else
            parts.details.push_back(token);
    }
    return parts;
}

/// "0.9" and "0.90" are the same figure; anything else compares as text.
bool isSameDetail(const std::string& a, const std::string& b) {
    double x = 0;
    double y = 0;
    const auto readA = std::from_chars(a.data(), a.data() + a.size(), x);
    const auto readB = std::from_chars(b.data(), b.data() + b.size(), y);
    if (readA.ec == std::errc{} && readB.ec == std::errc{} && readA.ptr == a.data() + a.size() &&
        readB.ptr == b.data() + b.size()) {
        return x == y;
    }
    return a == b;
}

/// Parts of the full name that a name may leave out.
struct Shortened {
    bool family = false;  ///< the end: "1660" for "1660ID"
    bool figures = false; ///< the last decimals: "0.5" for "0.559"
};

bool isShortenedFigure(const std::string& shortened, const std::string& figure) {
    return shortened.find('.') != std::string::npos && figure.starts_with(shortened);
}

bool hasDetails(const NameParts& wanted, const NameParts& model, bool figuresMayBeShortened) {
    std::vector<std::string> open = model.details;
    if (!wanted.side.empty()) {
        const auto side =
            std::find_if(open.begin(), open.end(), [](const std::string& d) { return d == "l" || d == "r"; });
        if (side != open.end() && *side != wanted.side) return false;
        if (side != open.end()) open.erase(side);
    }
    for (const std::string& detail : wanted.details) {
        const auto found = std::find_if(open.begin(), open.end(), [&](const std::string& d) {
            return isSameDetail(d, detail) || (figuresMayBeShortened && isShortenedFigure(detail, d));
        });
        if (found == open.end()) return false;
        open.erase(found);
    }
    return true;
}

bool fits(const NameParts& wanted, const NameParts& model, Shortened shortened) {
    if (!wanted.series.empty() && wanted.series != model.series) return false;
    const bool isFamily =
        shortened.family ? model.family.starts_with(wanted.family) : model.family == wanted.family;
    return isFamily && hasDetails(wanted, model, shortened.figures);
}

std::vector<const RobotModel*> select(const std::vector<RobotModel>& models, std::string_view name) {
    std::vector<const RobotModel*> found;
    const NameParts wanted = takeApart(name);
    if (wanted.family.empty()) return found;
    for (const Shortened shortened : {Shortened{}, Shortened{true, false}, Shortened{false, true}}) {
        for (const RobotModel& model : models) {
            if (fits(wanted, takeApart(model.name), shortened)) found.push_back(&model);
        }
        if (!found.empty()) break;
    }
    // "IRB 5710-90/2.7" is complete, although a longer name may contain it.
    const auto isComplete = [&](const RobotModel* m) {
        return takeApart(m->name).details.size() == wanted.details.size();
    };
    if (found.size() > 1 && std::count_if(found.begin(), found.end(), isComplete) == 1) {
        return {*std::find_if(found.begin(), found.end(), isComplete)};
    }
    return found;
}

std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = std::exchange(row[j], std::min({substituted, row[j] + 1, row[j - 1] + 1}));
        }
    }
    return row.back();
}

std::string joined(const std::vector<const RobotModel*>& models, std::size_t limit) {
    std::string text;
    for (std::size_t i = 0; i < models.size() && i < limit; ++i) {
        text += fmt::format("{}'{}'", i == 0 ? "" : ", ", models[i]->name);
    }
    if (models.size() > limit) text += fmt::format(" and {} more", models.size() - limit);
    return text;
}

std::string nearNames(const std::vector<RobotModel>& models, std::string_view name) {
    const auto squeezed = [](std::string_view text) {
        std::string result;
        for (const std::string& token : tokens(text))
            result += token;
        return result;
    };
    const std::string wanted = squeezed(name.substr(0, 100));
    const std::string family = takeApart(name.substr(0, 100)).family;
    std::vector<std::pair<std::size_t, std::size_t>> ranked; // distance, index
    for (std::size_t i = 0; i < models.size(); ++i) {
        const std::size_t whole = editDistance(wanted, squeezed(models[i].name));
        ranked.emplace_back(whole + 2 * editDistance(family, takeApart(models[i].name).family), i);
    }
    std::sort(ranked.begin(), ranked.end());
    std::vector<const RobotModel*> best;
    for (std::size_t i = 0; i < ranked.size() && i < 4; ++i)
        best.push_back(&models[ranked[i].second]);
    return joined(best, 4);
}

Expected<RobotModel, ModelError> readFile(const std::filesystem::path& path) {
    std::error_code ignored; // a pipe or a device may have no end
    std::ifstream file;
    if (std::filesystem::is_regular_file(path, ignored)) file.open(path, std::ios::binary);
    std::ostringstream text;
    if (!file.is_open() || !(text << file.rdbuf())) {
        return Unexpected{ModelError{fmt::format("robot model file '{}' cannot be read", path.string())}};
    }
    return parseRobotModel(text.str(), fmt::format("'{}'", path.string()));
}

/// Adds the models of a folder; a file that is not a model is remembered, for it matters only when the search
/// fails.
void addFolder(const std::string& folder, std::vector<RobotModel>& models, std::string& problems) {
    std::vector<std::filesystem::path> files;
    std::error_code problem;
    for (std::filesystem::directory_iterator entry(folder, problem), end; !problem && entry != end;
         entry.increment(problem)) {
        if (entry->path().extension() == ".json") files.push_back(entry->path());
    }
    if (problem) problems += fmt::format("; folder '{}' cannot be read: {}", folder, problem.message());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) {
        auto model = readFile(file);
        if (!model) {
            problems += "; " + model.error().message;
            continue;
        }
        const auto hasName = [&](const RobotModel& m) { return m.name == model->name; };
        if (std::none_of(models.begin(), models.end(), hasName)) models.push_back(std::move(*model));
    }
}

void addEmbedded(std::vector<RobotModel>& models) {
    for (std::string_view text : embeddedModelTexts()) {
        auto model = parseRobotModel(text, "shipped with rapidc");
        if (!model) continue; // a test reads every shipped file
        const auto hasName = [&](const RobotModel& m) { return m.name == model->name; };
        if (std::none_of(models.begin(), models.end(), hasName)) models.push_back(std::move(*model));
    }
}

} // namespace

Expected<RobotModel, ModelError> loadRobotModel(std::string_view nameOrPath,
                                                std::span<const std::string> searchDirs) {
    if (nameOrPath.size() > 5 && nameOrPath.substr(nameOrPath.size() - 5) == ".json") {
        return readFile(std::string(nameOrPath));
    }
    if (searchDirs.empty()) { // the usual case without reading all models
        const std::string line = fmt::format("\"name\": \"{}\",", nameOrPath);
        for (std::string_view text : embeddedModelTexts()) {
            if (text.find(line) != std::string_view::npos)
                return parseRobotModel(text, "shipped with rapidc");
        }
    }
    std::vector<RobotModel> models;
    std::string problems;
    for (const std::string& folder : searchDirs)
        addFolder(folder, models, problems);
    addEmbedded(models);

    for (const RobotModel& model : models) {
        if (model.name == nameOrPath) return model;
    }
    const auto found = select(models, nameOrPath);
    if (found.size() == 1) return *found.front();
    if (found.size() > 1) {
        return Unexpected{
            ModelError{fmt::format("robot model '{}' is ambiguous: it may be {}; give the full name",
                                   nameOrPath, joined(found, 12))}};
    }
    return Unexpected{ModelError{fmt::format("no robot model is called '{}'; near names are {}{}", nameOrPath,
                                             nearNames(models, nameOrPath), problems)}};
}

namespace {

/// The first two figures of a name: "IRB 1200-5/0.9" has the payload (kg) first, "ROB1_1200_0.9_5" the reach (m).
struct Figures {
    double payload = 0, reach = 0; ///< 0: not given
};

Figures figuresOf(std::string_view name, const NameParts& parts) {
    std::vector<double> figures;
    for (const std::string& detail : parts.details) {
        double figure = 0;
        const auto read = std::from_chars(detail.data(), detail.data() + detail.size(), figure);
        if (read.ec == std::errc{} && read.ptr == detail.data() + detail.size() && figure > 0)
            figures.push_back(figure);
    }
    figures.resize(2);
    if (name.starts_with("ROB")) std::swap(figures[0], figures[1]);
    const bool isInMm = figures[1] >= kMmPerMetre; // no arm reaches a kilometre
    return {figures[0], isInMm ? figures[1] / kMmPerMetre : figures[1]};
}

/// How different two robots are. The reach decides more than the payload: targets have to be reached.
double difference(const NameParts& family, const NameParts& model, const Figures& wanted, const Figures& is) {
    constexpr double kOfReach = 6;
    const auto ratio = [](double a, double b) { return a > 0 && b > 0 ? std::fabs(std::log(a / b)) : 0; };
    return std::numbers::ln2 * static_cast<double>(editDistance(family.family, model.family)) +
           kOfReach * ratio(wanted.reach, is.reach) + ratio(wanted.payload, is.payload);
}

} // namespace

std::string similarRobotModel(std::string_view name) {
    constexpr std::size_t kMostChanges = 2, kLongest = 100; // of the family; characters
    const NameParts wanted = takeApart(name.substr(0, kLongest));
    std::string best;
    if (wanted.family.empty()) return best;
    double least = std::numeric_limits<double>::infinity();
    for (const std::string& candidate : robotModelNames()) {
        const NameParts model = takeApart(candidate);
        if (model.family.size() != wanted.family.size() || model.family.front() != wanted.family.front() ||
            editDistance(wanted.family, model.family) > kMostChanges)
            continue;
        const double now = difference(wanted, model, figuresOf(name, wanted), figuresOf(candidate, model));
        if (now >= least) continue;
        least = now;
        best = candidate;
    }
    return best;
}

std::vector<std::string> robotModelNames() {
    std::vector<RobotModel> models;
    addEmbedded(models);
    std::vector<std::string> names;
    for (const RobotModel& model : models)
        names.push_back(model.name);
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace robot
