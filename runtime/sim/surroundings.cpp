#include "runtime/sim/surroundings.h"

#include "runtime/base/text_util.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace rt {
namespace {

/// How many of a quantity there are: 0 one without a number, else numbers from 1 on.
struct Quantity {
    const char* name;
    int most;
};
constexpr int kMostVariables = 65535; // a sensor numbers its variables with 16 bits
constexpr Quantity kQuantities[] = {{Surroundings::kExternalTorque, 7},
                                    {Surroundings::kForce, 6},
                                    {Surroundings::kPart, 0},
                                    {Surroundings::kLoadMass, 0},
                                    {Surroundings::kLoadCentre, 3},
                                    {Surroundings::kLoadInertia, 3},
                                    {Surroundings::kThickness, 0},
                                    {Surroundings::kTipWear, 0},
                                    {Surroundings::kInitialized, 0},
                                    {Surroundings::kSynchronized, 0},
                                    {Surroundings::kVariable, kMostVariables},
                                    {Surroundings::kVacuumFailure, 2},
                                    {Surroundings::kFault, 0},
                                    {Surroundings::kSpeed, 0},
                                    {Surroundings::kObject, 0}};

/// The number after the last underscore of "variable_8"; 0 when there is none.
int numberIn(std::string_view text, std::string_view& name) {
    const std::size_t end = text.rfind('_');
    const std::string_view digits = end == std::string_view::npos ? "" : text.substr(end + 1);
    name = text;
    if (digits.empty() || digits.size() > 5 ||
        !std::all_of(digits.begin(), digits.end(), [](unsigned char c) { return std::isdigit(c) != 0; }))
        return 0;
    name = text.substr(0, end);
    return std::stoi(std::string(digits));
}

} // namespace

std::optional<Surroundings::Name> Surroundings::split(std::string_view text) {
    const std::size_t dot = text.find('.');
    if (dot == std::string_view::npos || dot == 0 || dot + 1 == text.size()) return std::nullopt;
    return Name{std::string(text.substr(0, dot)), std::string(text.substr(dot + 1))};
}

std::string Surroundings::problemOf(std::string_view quantity) {
    std::string_view name;
    const int number = numberIn(quantity, name);
    std::string known;
    for (const Quantity& q : kQuantities) {
        if (sameName(name, q.name) && (q.most == 0 ? number == 0 : number >= 1 && number <= q.most))
            return {};
        known += fmt::format("{}{}{}", known.empty() ? "" : ", ", q.name, q.most > 0 ? "_N" : "");
    }
    return fmt::format("'{}' is not a quantity of a simulated device; expected {}", quantity, known);
}

void Surroundings::set(const Name& name, double value) {
    values_[{upperCase(name.unit), upperCase(name.quantity)}] = value;
    const auto listeners = listeners_; // one may remove itself
    for (const auto& [token, listener] : listeners)
        listener(name, value);
}

std::optional<double> Surroundings::find(std::string_view unit, std::string_view quantity) const {
    const auto found = values_.find({upperCase(unit), upperCase(quantity)});
    return found == values_.end() ? std::nullopt : std::optional<double>(found->second);
}

std::optional<double> Surroundings::find(std::string_view unit, const char* quantity, int number) const {
    return find(unit, fmt::format("{}_{}", quantity, number));
}

uint64_t Surroundings::addListener(std::function<void(const Name&, double)> listener) {
    listeners_[++lastToken_] = std::move(listener);
    return lastToken_;
}

} // namespace rt
